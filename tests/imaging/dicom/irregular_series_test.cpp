// Series with a tilted gantry, missing slices or both, as files.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "imaging/dicom/dicom_values.h"
#include "imaging/load_study.h"
#include "imaging/results/results.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::irregular_series_test {

namespace fs = std::filesystem;

namespace {

constexpr imaging::GridPolicy kFill{imaging::GridPolicy::Tilt::correct, imaging::GridPolicy::Gaps::fill};
constexpr imaging::GridPolicy kKeep{imaging::GridPolicy::Tilt::keep, imaging::GridPolicy::Gaps::refuse};
constexpr Index3 kSize{12, 10, 8};

bool says(const std::vector<std::string>& lines, const std::string& part) {
  return std::any_of(lines.begin(), lines.end(),
                     [&](const std::string& line) { return line.find(part) != std::string::npos; });
}

double value_at(const Volume& volume, Index3 voxel) {
  return static_cast<double>(volume.value(voxel));
}

}  // namespace

class IrregularSeriesTest : public QObject {
  Q_OBJECT

  test::TemporaryFolder folder_;
  Volume whole_;
  std::vector<fs::path> files_;

 private slots:
  void init() {
    fs::remove_all(folder_ / "series");
    whole_ = test::sample_volume(kSize);
    files_ = test::write_series(whole_, folder_ / "series");
  }

  void a_gap_is_refused_and_filled_when_that_is_asked_for() {
    fs::remove(files_[3]);
    const auto found = imaging::find_series(folder_ / "series");
    QCOMPARE(test::failure(found), QString());
    const imaging::Series& refused = found->series.front();
    QVERIFY(!refused.loadable && refused.fillable());
    QVERIFY2(says({refused.reason}, "1 slice is missing between " + files_[2].filename().string()),
             refused.reason.c_str());
    QVERIFY(imaging::find_fillable(*found, refused.uid) != nullptr);
    QVERIFY(imaging::find_fillable(*found, "1.2.3") == nullptr);
    QVERIFY(!imaging::load_volume(folder_ / "series"));

    const auto loaded = imaging::load_with_series(folder_ / "series", {}, {}, kFill);
    QCOMPARE(test::failure(loaded), QString());
    QCOMPARE(loaded->series.policy, kFill);
    QCOMPARE(imaging::by_policy(refused, kFill).geometry, loaded->series.geometry);
    QCOMPARE(loaded->series.files.size(), std::size_t{7});
    const Volume& volume = loaded->volume;
    QVERIFY(same_grid(volume.geometry, whole_.geometry, 1e-3));
    QCOMPARE(std::string(volume.scalar_name()), std::string("int16"));
    QVERIFY(says(volume.changes, "slice 4 of 8 (7.500 mm from the first) is interpolated between"));
    for (std::int64_t offset = 0; offset < volume.geometry.voxel_count(); ++offset) {
      const std::int64_t slice = kSize.x * kSize.y;
      const bool is_new = offset / slice == 3;
      const float wanted =
          is_new ? std::round((whole_.value(offset - slice) + whole_.value(offset + slice)) / 2.0F)
                 : whole_.value(offset);
      QVERIFY(std::abs(volume.value(offset) - wanted) <= (is_new ? 0.5F : 0.0F));
    }
  }

  void a_tilt_is_corrected_unless_it_is_kept() {
    test::tilt(files_, whole_.geometry, 0.9);  // one pixel a slice: nothing is interpolated
    const auto loaded = imaging::load_with_series(folder_ / "series");
    QCOMPARE(test::failure(loaded), QString());
    const Volume& volume = loaded->volume;
    QCOMPARE(volume.geometry.size, kSize + Index3(0, 7, 0));
    QVERIFY2(says(volume.changes, "gantry tilt of 19.8 degrees corrected"), volume.changes.back().c_str());
    for (std::int64_t k = 0; k < kSize.z; ++k) {
      QCOMPARE(value_at(volume, {4, 2 + k, k}), value_at(whole_, {4, 2, k}));
      if (k > 0) QCOMPARE(value_at(volume, {4, k - 1, k}), -1024.0);  // air: the series is CT
    }
    const auto kept = imaging::load_with_series(folder_ / "series", {}, {}, kKeep);
    QCOMPARE(test::failure(kept), QString());
    QCOMPARE(kept->volume.voxels, whole_.voxels);
    QVERIFY(same_grid(kept->volume.geometry, whole_.geometry, 1e-3));
    QVERIFY(says(kept->volume.changes, "tilted by 19.8 degrees"));
    QVERIFY(says(kept->series.warnings, "sheared"));
  }

  // Also where the padding value was written without the sign that the pixels have.
  void padding_is_what_lies_beside_the_slices() {
    test::tilt(files_, whole_.geometry, 0.45);
    for (const bool has_sign : {true, false}) {
      for (const fs::path& file : files_) {
        test::edit(file, [&](DcmDataset& dataset) {
          delete dataset.remove(DCM_PixelPaddingValue);
          if (has_sign) {
            dataset.putAndInsertSint16(DcmTag(DCM_PixelPaddingValue, EVR_SS), -2000);
          } else {
            dataset.putAndInsertUint16(DcmTag(DCM_PixelPaddingValue, EVR_US), 65536 - 2000);
          }
        });
      }
      const auto volume = imaging::load_volume(folder_ / "series");
      QCOMPARE(test::failure(volume), QString());
      QCOMPARE(value_at(*volume, {0, 0, 7}), -2000.0);
    }
  }

  void a_slice_of_an_irregular_series_is_read_alone() {
    fs::remove(files_[5]);
    std::vector<fs::path> rest = files_;
    test::tilt(files_ = {files_[0], files_[1], files_[2], files_[3], files_[4]}, whole_.geometry, 0.3);
    for (const std::size_t k : {std::size_t{6}, std::size_t{7}}) {
      const auto step = static_cast<double>(k);
      const glm::dvec3 place =
          whole_.geometry.to_patient({0.0, 0.0, step}) + 0.3 * step * whole_.geometry.direction[1];
      test::set_text(rest[k], 0x0020, 0x0032, imaging::decimals(place.x, place.y, place.z).c_str());
    }
    const auto loaded = imaging::load_with_series(folder_ / "series", {}, {}, kFill);
    QCOMPARE(test::failure(loaded), QString());
    const Volume& volume = loaded->volume;
    QCOMPARE(volume.geometry.size.z, kSize.z);
    for (std::int64_t k = 0; k < kSize.z; ++k) {
      const auto slice = imaging::load_slice(loaded->series, k);
      QCOMPARE(test::failure(slice), QString());
      const Index3 size = slice->geometry.size;
      QCOMPARE(size, Index3(volume.geometry.size.x, volume.geometry.size.y, 1));
      for (std::int64_t v = 0; v < size.x * size.y; ++v) {
        QCOMPARE(slice->value(v), volume.value(v + size.x * size.y * k));
      }
    }
  }

  void results_refer_to_images_only_where_their_slices_lie() {
    fs::remove(files_[3]);
    const auto loaded = imaging::load_with_series(folder_ / "series", {}, {}, kFill);
    QCOMPARE(test::failure(loaded), QString());
    imaging::Segments segments{loaded->volume.geometry, {}, {}};
    imaging::Segment segment;
    segment.name = "All";
    for (std::int64_t k = 0; k < kSize.z; ++k) segment.slices[k] = std::vector<std::uint8_t>(120, 1);
    segments.list.push_back(segment);
    const auto sources = imaging::dicom_files_of(loaded->series);
    QCOMPARE(test::failure(imaging::write_segmentation(segments, sources, folder_ / "seg.dcm")), QString());
    DcmFileFormat written;
    QVERIFY(written.loadFile((folder_ / "seg.dcm").c_str()).good());
    DcmSequenceOfItems* frames = nullptr;
    QVERIFY(written.getDataset()->findAndGetSequence(DCM_PerFrameFunctionalGroupsSequence, frames).good());
    QCOMPARE(frames->card(), 8UL);
    for (unsigned long k = 0; k < 8; ++k) {
      DcmSequenceOfItems* derivation = nullptr;
      const bool refers =
          frames->getItem(k)->findAndGetSequence(DCM_DerivationImageSequence, derivation).good();
      QCOMPARE(refers, k != 3);
      OFString place;
      DcmItem* plane = nullptr;
      QVERIFY(frames->getItem(k)->findAndGetSequenceItem(DCM_PlanePositionSequence, plane).good());
      QVERIFY(plane->findAndGetOFStringArray(DCM_ImagePositionPatient, place).good());
      const glm::dvec3 wanted = whole_.geometry.to_patient({0.0, 0.0, static_cast<double>(k)});
      glm::dvec3 told(0.0);
      QCOMPARE(std::sscanf(place.c_str(), "%lf\\%lf\\%lf", &told.x, &told.y, &told.z), 3);
      QVERIFY(glm::distance(told, wanted) < 1e-3);
    }
    const auto read = imaging::read_segmentation(folder_ / "seg.dcm", &loaded->volume.geometry);
    QCOMPARE(test::failure(read), QString());
    QVERIFY(read->list.front().slices == segment.slices);
  }

  // Results in coordinates that are not the patient's must not get back among the patient's images.
  void results_on_slices_whose_tilt_was_kept_are_refused() {
    test::tilt(files_, whole_.geometry, 0.9);
    for (const imaging::GridPolicy& policy : {imaging::GridPolicy(), kKeep}) {
      const auto loaded = imaging::load_with_series(folder_ / "series", {}, {}, policy);
      QCOMPARE(test::failure(loaded), QString());
      const Geometry& grid = loaded->volume.geometry;
      imaging::Segments segments{grid, {}, {}};
      imaging::Segment segment;
      segment.slices[2] = std::vector<std::uint8_t>(static_cast<std::size_t>(grid.size.x * grid.size.y), 1);
      segments.list.push_back(segment);
      const auto sources = imaging::dicom_files_of(loaded->series);
      const Status seg = imaging::write_segmentation(segments, sources, folder_ / "seg.dcm");
      const Status contours = imaging::write_structure_set(segments, sources, folder_ / "contours.dcm");
      QCOMPARE(seg.has_value(), policy == imaging::GridPolicy());
      QCOMPARE(contours.has_value(), policy == imaging::GridPolicy());
      if (!seg)
        QVERIFY2(says({seg.error().message}, "gantry tilt that was kept"), seg.error().message.c_str());
    }
  }

  // Places that nobody was scanned at, and a tilt by many of the smallest pixels: a grid of all that would
  // not fit any memory.
  void no_attribute_makes_a_grid_much_larger_than_the_images() {
    test::tilt(files_, whole_.geometry, 0.9);
    for (const fs::path& file : files_) test::set_text(file, 0x0028, 0x0030, "0.00001\\0.00001");
    const imaging::Series wide = imaging::find_series(folder_ / "series")->series.front();
    QVERIFY(!wide.loadable && !wide.fillable());
    QVERIFY2(says({wide.reason}, "times as many voxels"), wide.reason.c_str());

    files_ = test::write_series(whole_, folder_ / "far");
    const glm::dvec3 away = whole_.geometry.to_patient({0.0, 0.0, 3e5});
    test::set_text(files_.back(), 0x0020, 0x0032, imaging::decimals(away.x, away.y, away.z).c_str());
    for (const imaging::GridPolicy& policy : {imaging::GridPolicy(), kFill}) {
      const auto found = imaging::find_series(folder_ / "far", {}, policy);
      QCOMPARE(test::failure(found), QString());
      QVERIFY(!found->series.front().loadable && !found->series.front().fillable());
    }
  }

  // Of numbers that no scanner writes.
  void odd_padding_and_rescaling_are_no_way_out_of_the_types() {
    test::tilt(files_, whole_.geometry, 0.45);
    for (const fs::path& file : files_) {
      test::set_text(file, 0x0028, 0x1053, "1e-30");
      test::set_text(file, 0x0028, 0x1052, "1e30");
    }
    const auto tiny = imaging::load_volume(folder_ / "series");
    QCOMPARE(test::failure(tiny), QString());
    QCOMPARE(std::get<std::vector<std::int16_t>>(
                 tiny->voxels)[static_cast<std::size_t>(tiny->geometry.offset({0, 0, 7}))],
             std::int16_t{-32768});
    for (const fs::path& file : files_) {
      test::edit(file, [](DcmDataset& dataset) {
        dataset.putAndInsertString(DcmTag(DCM_PixelPaddingValue, EVR_UT), "none");
      });
    }
    QCOMPARE(test::failure(imaging::load_volume(folder_ / "series")), QString());
  }

  void the_same_files_give_the_same_error_whoever_decodes_them() {
    test::tilt(files_, whole_.geometry, 0.45);
    const auto found = imaging::find_series(folder_ / "series");
    QCOMPARE(test::failure(found), QString());
    QVERIFY(found->series.front().loadable);
    test::truncate(files_[4], fs::file_size(files_[4]) - 100);
    const auto volume = imaging::load_series(found->series.front());
    QVERIFY(!volume);
    QVERIFY2(says({volume.error().message}, files_[4].string()), volume.error().message.c_str());
  }
};

TIDEMARK_TEST(IrregularSeriesTest)

}  // namespace tidemark::test::irregular_series_test

#include "irregular_series_test.moc"
