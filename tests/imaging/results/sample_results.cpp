#include "tests/imaging/results/sample_results.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QJsonDocument>
#include <QProcess>
#include <QTest>
#include <cmath>
#include <glm/geometric.hpp>

#include "imaging/dicom/dicom.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/support/support.h"

namespace tidemark::test {
namespace {

glm::dmat3 planes(glm::dvec3 row, glm::dvec3 column) {
  return {row, column, glm::cross(row, column)};
}

glm::dmat3 oblique() {
  const glm::dvec3 row = glm::normalize(glm::dvec3(1.0, 0.3, -0.2));
  return planes(row, glm::normalize(glm::cross(glm::dvec3(0.1, 0.2, 1.0), row)));
}

}  // namespace

const std::vector<Orientation>& orientations() {
  const glm::dvec3 x(1.0, 0.0, 0.0);
  const glm::dvec3 y(0.0, 1.0, 0.0);
  const glm::dvec3 z(0.0, 0.0, 1.0);
  static const std::vector<Orientation> all{{"axial", planes(x, y)},
                                            {"axial, prone", planes(-x, -y)},
                                            {"axial, feet first", planes(-x, y)},
                                            {"sagittal", planes(y, -z)},
                                            {"sagittal, mirrored", planes(-y, -z)},
                                            {"coronal", planes(x, -z)},
                                            {"coronal, mirrored", planes(-x, -z)},
                                            {"oblique", oblique()}};
  return all;
}

Geometry sample_grid(Index3 size, const glm::dmat3& direction) {
  Geometry geometry;
  geometry.size = size;
  geometry.spacing_mm = {0.7, 0.9, 2.5};
  geometry.direction = direction;
  geometry.origin_mm = {-101.25, 37.5, 512.125};
  return geometry;
}

SampleSeries write_sample_series(const Geometry& geometry, const std::filesystem::path& folder) {
  Volume volume;
  volume.geometry = geometry;
  volume.voxels = std::vector<std::int16_t>(static_cast<std::size_t>(geometry.voxel_count()), 40);
  write_series(volume, folder);
  const imaging::Series series = only_series(folder);
  return {folder, series.files, series.geometry};
}

SampleSeries write_oriented_series(int index, Index3 size, const std::filesystem::path& folder) {
  return write_sample_series(sample_grid(size, orientations()[static_cast<std::size_t>(index)].direction),
                             folder);
}

void add_orientation_rows() {
  QTest::addColumn<int>("index");
  int index = 0;
  for (const Orientation& orientation : orientations()) QTest::newRow(orientation.name) << index++;
}

void add_script_rows() {
  QTest::addColumn<QByteArray>("character_set");
  QTest::addColumn<QByteArray>("bytes");
  QTest::addColumn<QByteArray>("name");
  const auto row = [](const char* title, const char* character_set, const char* bytes, const char* name) {
    QTest::newRow(title) << QByteArray(character_set) << QByteArray(bytes) << QByteArray(name);
  };
  row("Latin 1", "ISO_IR 100", "Buc^J\xe9r\xf4me", "Buc^Jérôme");
  row("UTF-8", "ISO_IR 192", "Wang^XiaoDong=王^小東", "Wang^XiaoDong=王^小東");
  row("Japanese", "\\ISO 2022 IR 87", "Yamada^Tarou=\x1b$B;3ED\x1b(B^\x1b$BB@O:\x1b(B",
      "Yamada^Tarou=山田^太郎");
  row("Japanese with katakana", "ISO 2022 IR 13\\ISO 2022 IR 87",
      "\xd4\xcf\xc0\xde^\xc0\xdb\xb3=\x1b$B;3ED\x1b(J^\x1b$BB@O:\x1b(J", "ﾔﾏﾀﾞ^ﾀﾛｳ=山田^太郎");
  row("Korean", "\\ISO 2022 IR 149", "Hong^Gildong=\x1b$)C\xfb\xf3^\x1b$)C\xd1\xce\xd4\xd7",
      "Hong^Gildong=洪^吉洞");
  row("Japanese that is cut off", "\\ISO 2022 IR 87", "A=\x1b$B;", "A=?$B;");
  row("no character set", "", "M\xfcller^Eva", "Müller^Eva");
  row("an unknown character set", "KLINGON", "K\xe9hlar", "Kéhlar");
  row("the wrong character set", "ISO_IR 192", "M\xfcller^Eva", "Müller^Eva");
}

imaging::Segments speckled_segments(const Geometry& geometry) {
  imaging::Segments segments{geometry, {}, {}};
  const std::array<imaging::SegmentColour, 3> colours{{{230, 159, 0}, {0, 114, 178}, {1, 2, 3}}};
  const std::array<const char*, 3> names{"Leber \xc3\xbc", "tumour", "a third, with\\backslash"};
  const std::array<const char*, 3> meanings{"liver", "tumour", "tissue"};
  for (std::size_t n = 0; n < 3; ++n) {
    std::vector<std::uint8_t> voxels(static_cast<std::size_t>(geometry.voxel_count()));
    for (std::size_t v = 0; v < voxels.size(); ++v) {
      const auto k = static_cast<std::int64_t>(v) / (geometry.size.x * geometry.size.y);
      const bool left_out = k % 3 == static_cast<std::int64_t>(n);
      voxels[v] = !left_out && ((v + 1) * 2654435761U >> (9 + n)) % 5 < 2 ? 1 : 0;
    }
    imaging::Segment segment;
    segment.name = names[n];
    segment.colour = colours[n];
    segment.meaning = *imaging::find_segment_meaning(meanings[n]);
    segment.slices = imaging::slices_of(geometry, voxels);
    segments.list.push_back(std::move(segment));
  }
  return segments;
}

void write_speckled_segmentation(const std::filesystem::path& file, const Geometry& geometry,
                                 imaging::SourceFiles source) {
  QCOMPARE(failure(imaging::write_segmentation(speckled_segments(geometry), source, file)), QString());
}

void verify_same(const imaging::Segments& read, const imaging::Segments& written) {
  QCOMPARE(read.list.size(), written.list.size());
  for (std::size_t n = 0; n < read.list.size(); ++n) {
    QVERIFY2(read.list[n].slices == written.list[n].slices, written.list[n].name.c_str());
    QVERIFY(read.list[n].colour == written.list[n].colour);
    QVERIFY(read.list[n].meaning == written.list[n].meaning);
  }
}

void renumber_segments(const std::filesystem::path& file, const std::vector<std::uint16_t>& numbers) {
  edit(file, [&](DcmDataset& dataset) {
    DcmSequenceOfItems* segments = nullptr;
    DcmSequenceOfItems* frames = nullptr;
    QVERIFY(dataset.findAndGetSequence(DCM_SegmentSequence, segments).good());
    QVERIFY(dataset.findAndGetSequence(DCM_PerFrameFunctionalGroupsSequence, frames).good());
    QCOMPARE(std::size_t{segments->card()}, numbers.size());
    for (unsigned long n = 0; n < segments->card(); ++n)
      segments->getItem(n)->putAndInsertUint16(DCM_SegmentNumber, numbers[n]);
    for (unsigned long n = 0; n < frames->card(); ++n) {
      DcmItem* frame = nullptr;
      Uint16 number = 0;
      QVERIFY(frames->getItem(n)->findAndGetSequenceItem(DCM_SegmentIdentificationSequence, frame).good());
      QVERIFY(frame->findAndGetUint16(DCM_ReferencedSegmentNumber, number).good());
      frame->putAndInsertUint16(DCM_ReferencedSegmentNumber, numbers.at(number - 1U));
    }
  });
}

void make_parametric_map(const std::filesystem::path& file, const std::vector<std::int16_t>& stored,
                         double slope, double intercept) {
  edit(file, [&](DcmDataset& dataset) {
    dataset.putAndInsertString(DCM_SOPClassUID, UID_ParametricMapStorage);
    dataset.putAndInsertString(DCM_Modality, "MR");
    for (const DcmTagKey& key : {DCM_SegmentSequence, DCM_SegmentationType, DCM_PixelData})
      dataset.findAndDeleteElement(key);
    DcmItem* shared = nullptr;
    DcmItem* mapping = nullptr;
    QVERIFY(dataset.findOrCreateSequenceItem(DCM_SharedFunctionalGroupsSequence, shared, 0).good());
    QVERIFY(shared->findOrCreateSequenceItem(DCM_RealWorldValueMappingSequence, mapping, 0).good());
    mapping->putAndInsertFloat64(DCM_RealWorldValueSlope, slope);
    mapping->putAndInsertFloat64(DCM_RealWorldValueIntercept, intercept);
    dataset.putAndInsertUint16(DCM_BitsAllocated, 16);
    dataset.putAndInsertUint16(DCM_PixelRepresentation, 1);
    std::vector<Uint16> words;
    for (const std::int16_t word : stored) words.push_back(static_cast<Uint16>(word));
    const auto count = static_cast<unsigned long>(words.size());
    QVERIFY(dataset.putAndInsertUint16Array(DcmTag(DCM_PixelData, EVR_OW), words.data(), count).good());
  });
}

imaging::Segment ball_segment(const Geometry& geometry, double radius_mm, double hollow_mm) {
  const glm::dvec3 centre = geometry.to_patient(0.5 * glm::dvec3(geometry.size - Index3(1)));
  const glm::dvec3 h = geometry.spacing_mm;
  std::vector<float> phi;
  std::vector<std::uint8_t> inside;
  for (std::int64_t k = 0; k < geometry.size.z; ++k) {
    for (std::int64_t j = 0; j < geometry.size.y; ++j) {
      for (std::int64_t i = 0; i < geometry.size.x; ++i) {
        const double r = glm::distance(centre, geometry.to_patient({i, j, k}));
        const double mm = hollow_mm > 0.0 ? std::min(radius_mm - r, r - hollow_mm) : radius_mm - r;
        phi.push_back(static_cast<float>(std::clamp(mm / std::min({h.x, h.y, h.z}), -3.0, 3.0)));
        inside.push_back(phi.back() > 0.0F ? 1 : 0);
      }
    }
  }
  imaging::Segment segment;
  segment.name = "ball";
  segment.slices = imaging::slices_of(geometry, inside);
  auto volume = std::make_shared<Volume>();
  volume->geometry = geometry;
  volume->voxels = std::move(phi);
  segment.phi = std::move(volume);
  return segment;
}

QString validate(const std::filesystem::path& file) {
  QProcess validator;
  validator.setProcessChannelMode(QProcess::MergedChannels);
  validator.start("dciodvfy", {QString::fromStdString(file.string())});
  if (!validator.waitForFinished()) return "Error - dciodvfy (package dicom3tools) does not run";
  return validator.readAll();
}

QJsonObject read_with_pydicom(const std::filesystem::path& file, const std::filesystem::path& source_folder) {
  QProcess python;
  // The system's own, which has the system's packages.
  python.start("/usr/bin/python3", {TIDEMARK_READ_RESULTS, QString::fromStdString(file.string()),
                                    QString::fromStdString(source_folder.string())});
  const bool ended = python.waitForFinished() && python.exitCode() == 0;
  if (!ended) {
    qFatal("pydicom (packages python3-pydicom, python3-numpy) cannot read it: %s",
           python.readAllStandardError().constData());
  }
  return QJsonDocument::fromJson(python.readAllStandardOutput()).object();
}

}  // namespace tidemark::test
