// Real series, against what other readers found in them (truth.json beside the studies).
#include <QCryptographicHash>
#include <QtEndian>
#include <algorithm>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "imaging/dicom/dicom.h"
#include "imaging/dicom/pixels.h"
#include "imaging/load_study.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::dicom_studies_test {

namespace fs = std::filesystem;

namespace {

// Where a truth entry's files lie: "FOLDER OR FILE | UID".
fs::path path_of(const std::string& study, const std::string& key) {
  return test::studies_folder() / study / key.substr(0, key.find(" | "));
}

glm::dvec3 vector_of(const nlohmann::json& numbers, std::size_t first = 0) {
  return {numbers.at(first).get<double>(), numbers.at(first + 1).get<double>(),
          numbers.at(first + 2).get<double>()};
}

double distance(glm::dvec3 a, glm::dvec3 b) {
  return glm::length(a - b);
}

void add_values(QCryptographicHash& hash, const std::vector<std::int32_t>& values) {
  for (const std::int32_t value : values) {
    const qint32 little = qToLittleEndian(value);
    hash.addData(QByteArrayView(reinterpret_cast<const char*>(&little), sizeof little));
  }
}

std::string uid_of(const std::string& name) {
  static const std::map<std::string, std::string> kUids{
      {"ImplLE", "1.2.840.10008.1.2"},        {"ExplLE", "1.2.840.10008.1.2.1"},
      {"Deflated", "1.2.840.10008.1.2.1.99"}, {"ExplBE", "1.2.840.10008.1.2.2"},
      {"JPEGLL14", "1.2.840.10008.1.2.4.57"}, {"JPEGLLSV1", "1.2.840.10008.1.2.4.70"},
      {"JPEGLS", "1.2.840.10008.1.2.4.80"},   {"J2Klossless", "1.2.840.10008.1.2.4.90"},
      {"RLE", "1.2.840.10008.1.2.5"}};
  return kUids.at(name);
}

// The files in the order in which their pixels were summed up; the reader's own where it is abridged.
std::vector<fs::path> files_in_order(const fs::path& path, const nlohmann::json& truth,
                                     const imaging::Catalogue& found) {
  if (!fs::is_directory(path)) return {path};
  std::vector<fs::path> files;
  if (truth.contains("order")) {
    for (const auto& name : truth.at("order")) files.push_back(path / name.get<std::string>());
  }
  const bool abridged =
      std::any_of(files.begin(), files.end(), [](const fs::path& f) { return f.filename() == "..."; });
  if ((files.empty() || abridged) && found.series.size() == 1) return found.series.front().files;
  return files;
}

}  // namespace

class DicomStudiesTest : public QObject {
  Q_OBJECT

  nlohmann::json truth_;

  void every_entry_of(const std::vector<const char*>& studies) const {
    QTest::addColumn<QString>("study");
    QTest::addColumn<QString>("key");
    for (const char* study : studies) {
      for (const auto& [key, entry] : truth_.at(study).at("series").items()) {
        if (entry.at("files") == 0) continue;
        QTest::addRow("%s %s", study, key.c_str()) << QString(study) << QString::fromStdString(key);
      }
    }
  }

  const nlohmann::json& entry_of(const QString& study, const QString& key) const {
    return truth_.at(study.toStdString()).at("series").at(key.toStdString());
  }

 private slots:
  void initTestCase() {
    std::ifstream stream(test::studies_folder() / "truth.json");
    truth_ = nlohmann::json::parse(stream, nullptr, false);
    QVERIFY(truth_.is_object());
  }

  void a_series_is_read_as_other_readers_read_it_data() {
    QTest::addColumn<QString>("study");
    QTest::addColumn<QString>("key");
    for (const char* study :
         {"d01_mrhead_ge_3d", "d02_ct_body_j2k_siemens", "d03_mr_tumour_brainix", "d08_series_compressed",
          "d10_slicecount", "d12_nonsquare_varying_rescale", "d13_hitachi_oblique_signed12",
          "d21_sarcoma_mr_rtstruct", "x01_mrhead3_syntaxes"}) {
      for (const auto& [key, entry] : truth_.at(study).at("series").items()) {
        if (!entry.contains("pixels_md5_int32le")) continue;  // holds no image
        QTest::addRow("%s %s", study, key.c_str()) << QString(study) << QString::fromStdString(key);
      }
    }
  }

  void a_series_is_read_as_other_readers_read_it() {
    QFETCH(QString, study);
    QFETCH(QString, key);
    const nlohmann::json& truth = entry_of(study, key);
    const fs::path path = path_of(study.toStdString(), key.toStdString());
    const auto found = imaging::scan_dicom(path);
    QCOMPARE(test::failure(found), QString());
    QCOMPARE(found->series.size(), std::size_t{1});
    const imaging::Series& series = found->series.front();
    QCOMPARE(QString::fromStdString(series.reason), QString());
    QVERIFY(series.loadable);

    QCOMPARE(series.files.size(), truth.at("files").get<std::size_t>());
    const auto& order = truth.at("order");
    for (std::size_t k = 0; k < series.files.size() && order.at(k) != "..."; ++k) {
      QCOMPARE(series.files[k].filename().string(), order.at(k).get<std::string>());
    }
    QCOMPARE(series.files.back().filename().string(), order.back().get<std::string>());
    QCOMPARE(series.modality, truth.at("Modality").get<std::string>());
    QCOMPARE(series.transfer_syntaxes, std::vector{uid_of(truth.at("transfer_syntax").at(0))});

    const Geometry& g = series.geometry;
    QCOMPARE(g.size, Index3(truth.at("rows_cols").at(0).at(1), truth.at("rows_cols").at(0).at(0),
                            series.files.size()));
    const glm::dvec3 spacing(truth.at("PixelSpacing").at(0).at(1).get<double>(),
                             truth.at("PixelSpacing").at(0).at(0).get<double>(),
                             truth.at("spacing_along_normal").at("median").get<double>());
    QVERIFY2(distance(g.spacing_mm, spacing) < 2e-3, qPrintable(QString::number(g.spacing_mm.z)));
    QVERIFY(distance(g.direction[0], vector_of(truth.at("ImageOrientationPatient"))) < 1e-5);
    QVERIFY(distance(g.direction[1], vector_of(truth.at("ImageOrientationPatient"), 3)) < 1e-5);
    QVERIFY(std::abs(glm::determinant(g.direction) - 1.0) < 1e-12);
    QVERIFY(distance(g.origin_mm, vector_of(truth.at("first_IPP"))) < 1e-3);
    const glm::dvec3 last = g.to_patient({0.0, 0.0, static_cast<double>(g.size.z - 1)});
    QVERIFY(distance(last, vector_of(truth.at("last_IPP"))) < 0.02);

    const auto volume = imaging::load_dicom(series);
    QCOMPARE(test::failure(volume), QString());
    QCOMPARE(volume->geometry, g);
    QCOMPARE(std::string(volume->scalar_name()), series.scalar);
    const auto [low, high] = volume->range();
    double sum = 0.0;
    const std::vector<float> values = volume->values();
    for (const float v : values) sum += static_cast<double>(v);
    const auto& rescaled = truth.at("rescaled");
    const auto near = [](double a, double b) { return std::abs(a - b) <= 1e-5 * std::max(1.0, std::abs(b)); };
    QVERIFY(near(static_cast<double>(low), rescaled.at("min")));
    QVERIFY(near(static_cast<double>(high), rescaled.at("max")));
    QVERIFY(near(sum / static_cast<double>(values.size()), rescaled.at("mean")));
    QCOMPARE(values.size(), rescaled.at("n").get<std::size_t>());
  }

  void pixels_are_decoded_as_other_readers_decode_them_data() {
    every_entry_of({"d01_mrhead_ge_3d", "d02_ct_body_j2k_siemens", "d03_mr_tumour_brainix", "d04_ct_tilt_ge",
                    "d07_syntaxes_same_pixels", "d08_series_compressed", "d09_gap_ct_ge", "d10_slicecount",
                    "d11_mixed_orientation", "d12_nonsquare_varying_rescale", "d13_hitachi_oblique_signed12",
                    "d14_4d_dti_ge", "d19_singles_pydicom", "d20_monochrome1", "d21_sarcoma_mr_rtstruct",
                    "x01_mrhead3_syntaxes"});
  }

  void pixels_are_decoded_as_other_readers_decode_them() {
    QFETCH(QString, study);
    QFETCH(QString, key);
    const nlohmann::json& truth = entry_of(study, key);
    const fs::path path = path_of(study.toStdString(), key.toStdString());
    // What is refused, and why. The padded file has 128 bytes too many; the stream with the delimiter inside
    // says that it is 3.7 billion pixels wide (another decoder makes noise of it).
    static const std::map<std::string, std::string> kRefused{
        {"MR_small_padded.dcm", "holds 8320 bytes"},
        {"JPEG2000-embedded-sequence-delimiter.dcm", "JPEG 2000 stream"},
        {"ExplVR_BigEnd.dcm", "SamplesPerPixel (0028,0002) is 3"},
        {"examples_jpeg2k.dcm", "SamplesPerPixel (0028,0002) is 3"},
        {"examples_palette.dcm", "PALETTE COLOR"},
        {"liver_1frame.dcm", "is a DICOM segmentation"},
        {"rtdose.dcm", "15 frames"},
        {"rtdose_expb.dcm", "15 frames"},
        {"rtdose_rle.dcm", "15 frames"}};
    const auto refused = kRefused.find(path.filename().string());
    if (refused != kRefused.end() || !truth.contains("pixels_md5_int32le")) {
      const auto slice = imaging::decode_frame(path);
      QVERIFY(!slice);
      QVERIFY2(slice.error().message.find(path.string()) != std::string::npos, slice.error().message.c_str());
      if (refused != kRefused.end()) {
        QVERIFY2(slice.error().message.find(refused->second) != std::string::npos,
                 slice.error().message.c_str());
      }
      return;
    }
    imaging::Catalogue found;
    if (fs::is_directory(path)) found = imaging::scan_dicom(path).value();
    QCryptographicHash hash(QCryptographicHash::Md5);
    for (const fs::path& file : files_in_order(path, truth, found)) {
      const auto slice = imaging::decode_frame(file);
      QCOMPARE(test::failure(slice), QString());
      add_values(hash, slice->pixels.stored);
    }
    QCOMPARE(hash.result().toHex().toStdString(), truth.at("pixels_md5_int32le").get<std::string>());
  }

  // Stripes of 0x0f0f and 0xffff in 12-bit images: what lies above the high bit does not count
  // (the other readers' sums keep it).
  void bits_above_the_high_bit_are_ignored() {
    const fs::path folder = test::studies_folder() / "d16_12bit" / "In";
    const auto without_sign = imaging::decode_frame(folder / "12bitUnsigned_0x0F0F.dcm");
    QCOMPARE(test::failure(without_sign), QString());
    QVERIFY(without_sign->pixels.ignored_bits);
    QCOMPARE(*std::max_element(without_sign->pixels.stored.begin(), without_sign->pixels.stored.end()), 4095);
    QVERIFY(std::count(without_sign->pixels.stored.begin(), without_sign->pixels.stored.end(), 0x0f0f) > 0);
    const auto with_sign = imaging::decode_frame(folder / "12bitSigned_0x0F0F.dcm");
    QCOMPARE(test::failure(with_sign), QString());
    QVERIFY(std::count(with_sign->pixels.stored.begin(), with_sign->pixels.stored.end(), -241) > 0);
    QVERIFY(std::count(with_sign->pixels.stored.begin(), with_sign->pixels.stored.end(), -1) > 0);
    QVERIFY(*std::min_element(with_sign->pixels.stored.begin(), with_sign->pixels.stored.end()) >= -2048);
  }

  void what_is_no_volume_is_refused_by_its_reason_data() {
    QTest::addColumn<QString>("study");
    QTest::addColumn<QStringList>("parts");
    const auto row = [](const char* study, const QStringList& parts) {
      QTest::addRow("%s", study) << QString(study) << parts;
    };
    row("d04_ct_tilt_ge", {"uneven slice distances", "14.dcm", "15.dcm", "1.081 mm", "4.002 mm"});
    row("d09_gap_ct_ge", {"1 slice is missing", "IM-0001-0009-0001.dcm", "IM-0001-0010-0001.dcm"});
    row("d17_rgb_not_a_volume", {"SamplesPerPixel", "RGB", "IM-0001-0001-0001.dcm"});
  }

  void what_is_no_volume_is_refused_by_its_reason() {
    QFETCH(QString, study);
    QFETCH(QStringList, parts);
    const auto found = imaging::scan_dicom(test::studies_folder() / study.toStdString());
    QCOMPARE(test::failure(found), QString());
    QCOMPARE(found->series.size(), std::size_t{1});
    const imaging::Series& series = found->series.front();
    QVERIFY(!series.loadable);
    for (const QString& part : parts) {
      QVERIFY2(QString::fromStdString(series.reason).contains(part), series.reason.c_str());
    }
    QVERIFY(!imaging::load_dicom(series));
  }

  // One slice is missing between the third and the fourth image.
  void a_missing_slice_is_filled() {
    constexpr imaging::GridPolicy kFill{imaging::GridPolicy::Tilt::correct, imaging::GridPolicy::Gaps::fill};
    const auto loaded = imaging::load_with_series(test::studies_folder() / "d09_gap_ct_ge", {}, {}, kFill);
    QCOMPARE(test::failure(loaded), QString());
    const Volume& volume = loaded->volume;
    QCOMPARE(volume.geometry.size, Index3(512, 512, 5));
    QVERIFY(distance(volume.geometry.spacing_mm, {0.429688, 0.429688, 5.0}) < 1e-5);
    for (std::size_t k = 0; k < 4; ++k) {
      const auto slice = imaging::decode_frame(loaded->series.files[k]);
      QCOMPARE(test::failure(slice), QString());
      const auto first = volume.geometry.offset({0, 0, k < 3 ? static_cast<std::int64_t>(k) : 4});
      for (std::int64_t v = 0; v < 512 * 512; ++v) {
        const auto wanted = static_cast<double>(slice->pixels.stored[static_cast<std::size_t>(v)]) - 1024.0;
        QCOMPARE(static_cast<double>(volume.value(first + v)), wanted);
      }
    }
    for (std::int64_t v = 0; v < 512 * 512; ++v) {
      const float low = volume.value(v + volume.geometry.offset({0, 0, 2}));
      const float high = volume.value(v + volume.geometry.offset({0, 0, 4}));
      QVERIFY(std::abs(volume.value(v + volume.geometry.offset({0, 0, 3})) - 0.5F * (low + high)) <= 0.5F);
    }
  }

  // 18.5 degrees; 4 mm along the normal, then 1.08 mm once, then 7 mm.
  void a_tilted_gantry_with_two_pitches_becomes_regular() {
    const fs::path study = test::studies_folder() / "d04_ct_tilt_ge";
    const auto corrected = imaging::load_with_series(
        study, {}, {}, {imaging::GridPolicy::Tilt::correct, imaging::GridPolicy::Gaps::fill});
    QCOMPARE(test::failure(corrected), QString());
    const Geometry& grid = corrected->volume.geometry;
    QCOMPARE(grid.size, Index3(512, 543, 12));  // 47.54 mm of table, sin 18.5 degrees of it in the rows
    QVERIFY(distance(grid.spacing_mm, {0.488281, 0.488281, 4.0019}) < 1e-3);
    const auto& slices = corrected->series.grid.slices;
    const nlohmann::json& truth = truth_.at("d04_ct_tilt_ge").at("series").begin().value();
    for (std::size_t k = 0; k < 5; ++k) {  // 4.22 mm of table each
      const glm::dvec3 first(slices[k][0].shift, static_cast<double>(k));
      const glm::dvec3 wanted =
          vector_of(truth.at("first_IPP")) + glm::dvec3(0.0, 0.0, 4.22 * static_cast<double>(k));
      QVERIFY(distance(grid.to_patient(first), wanted) < 0.01);
    }
    QCOMPARE(corrected->volume.range().first, -1500.0F);  // PixelPaddingValue
    const auto says = [&](const Volume& volume, const char* part) {
      return std::any_of(volume.changes.begin(), volume.changes.end(),
                         [&](const std::string& one) { return one.find(part) != std::string::npos; });
    };
    QVERIFY(says(corrected->volume, "tilt of 18.5 degrees corrected"));
    QVERIFY(says(corrected->volume, "12 slices 4.002 mm apart are made of 10"));

    const auto kept = imaging::load_with_series(
        study, {}, {}, {imaging::GridPolicy::Tilt::keep, imaging::GridPolicy::Gaps::fill});
    QCOMPARE(test::failure(kept), QString());
    QCOMPARE(kept->volume.geometry.size, Index3(512, 512, 12));
    QVERIFY(says(kept->volume, "tilted by 18.5 degrees"));
    const auto fourth = imaging::decode_frame(kept->series.files[4]);
    QCOMPARE(test::failure(fourth), QString());
    for (std::int64_t v = 0; v < 512 * 512; ++v) {
      QCOMPARE(static_cast<double>(kept->volume.value(v + 4 * 512 * 512)),
               static_cast<double>(fourth->pixels.stored[static_cast<std::size_t>(v)]));
    }
  }

  void of_every_odd_file_it_is_said_why_it_is_not_read_data() {
    QTest::addColumn<QString>("study");
    QTest::newRow("character sets") << "d18_charsets";
    QTest::newRow("single files") << "d19_singles_pydicom";
  }

  void of_every_odd_file_it_is_said_why_it_is_not_read() {
    QFETCH(QString, study);
    const fs::path folder = test::studies_folder() / study.toStdString();
    const auto found = imaging::scan_dicom(folder);
    QCOMPARE(test::failure(found), QString());
    std::set<fs::path> explained;
    for (const imaging::Series& series : found->series) {
      if (series.loadable) {  // one image is a volume of one slice
        QCOMPARE(series.files.size(), std::size_t{1});
        const auto slice = imaging::load_series(series);
        QCOMPARE(test::failure(slice), QString());
        QCOMPARE(slice->geometry.size.z, std::int64_t{1});
      } else {
        QVERIFY2(!series.reason.empty(), series.uid.c_str());
      }
      explained.insert(series.files.begin(), series.files.end());
    }
    for (const imaging::SkippedFile& skipped : found->skipped) {
      QVERIFY(!skipped.reason.empty());
      explained.insert(skipped.file);
    }
    std::size_t files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (!entry.is_regular_file()) continue;
      ++files;
      QVERIFY2(explained.contains(entry.path()), entry.path().c_str());
    }
    QCOMPARE(explained.size(), files);
  }

  void names_are_read_in_their_own_script() {
    const std::map<std::string, const char*> names{{"chrArab.dcm", "قباني, لنزار"},
                                                   {"chrFren.dcm", "Buc, Jérôme"},
                                                   {"chrFrenMulti.dcm", "Buc, Jérôme"},
                                                   {"chrGerm.dcm", "Äneas, Rüdiger"},
                                                   {"chrGreek.dcm", "Διονυσιος"},
                                                   {"chrH31.dcm", "山田 太郎 (Yamada, Tarou)"},
                                                   {"chrH32.dcm", "山田 太郎 (ﾔﾏﾀﾞ, ﾀﾛｳ)"},
                                                   {"chrHbrw.dcm", "שרון, דבורה"},
                                                   {"chrI2.dcm", "洪 吉洞 (Hong, Gildong)"},
                                                   {"chrJapMulti.dcm", "やまだ, たろう"},
                                                   {"chrJapMultiExplicitIR6.dcm", "やまだ, たろう"},
                                                   {"chrKoreanMulti.dcm", "김희중"},
                                                   {"chrRuss.dcm", "Люкceмбypг"},
                                                   {"chrX1.dcm", "王 小東 (Wang, XiaoDong)"},
                                                   {"chrX2.dcm", "王 小东 (Wang, XiaoDong)"}};
    const auto found = imaging::scan_dicom(test::studies_folder() / "d18_charsets");
    QCOMPARE(test::failure(found), QString());
    std::size_t seen = 0;
    for (const imaging::Series& series : found->series) {
      for (const fs::path& file : series.files) {
        const auto name = names.find(file.filename().string());
        if (name == names.end()) continue;
        ++seen;
        QCOMPARE(QString::fromStdString(series.patient.name), QString::fromUtf8(name->second));
      }
    }
    QCOMPARE(seen, names.size());
  }

  // Copies of one series in nine folders stay nine series.
  void copies_in_several_folders_are_not_mixed() {
    const auto found = imaging::scan_dicom(test::studies_folder() / "x01_mrhead3_syntaxes");
    QCOMPARE(test::failure(found), QString());
    QCOMPARE(found->series.size(), std::size_t{9});
    for (const imaging::Series& series : found->series) {
      QVERIFY2(series.loadable, series.reason.c_str());
      QCOMPARE(series.files.size(), std::size_t{3});
    }
  }
};

TIDEMARK_STUDY_TEST(DicomStudiesTest)

}  // namespace tidemark::test::dicom_studies_test

#include "dicom_studies_test.moc"
