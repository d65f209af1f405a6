// From headers to a grid, without files.
#include <algorithm>
#include <clocale>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "imaging/dicom/decimal.h"
#include "imaging/dicom/series_geometry.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::series_geometry_test {

namespace {

// Slices of 10 x 8 pixels of 0.5 x 0.6 mm, `distance` mm apart along the normal of an oblique orientation.
std::vector<imaging::SliceHeader> regular(int count, double distance) {
  const glm::dvec3 row = glm::normalize(glm::dvec3(1.0, 0.1, 0.3));
  const glm::dvec3 column = glm::normalize(glm::cross(glm::dvec3(0.2, 0.0, 1.0), row));
  std::vector<imaging::SliceHeader> slices;
  for (int k = 0; k < count; ++k) {
    imaging::SliceHeader slice;
    slice.file = fmt::format("folder/{:03}", k);
    slice.series_uid = "1.2.3";
    slice.sop_instance_uid = fmt::format("1.2.3.{}", k);
    slice.transfer_syntax = "1.2.840.10008.1.2.1";
    slice.rows = 8;
    slice.columns = 10;
    slice.bits_allocated = slice.bits_stored = 16;
    slice.high_bit = 15;
    slice.orientation = {row, column};
    slice.position_mm = glm::dvec3(5.0, -6.0, 7.0) + distance * k * glm::cross(row, column);
    slice.pixel_spacing_mm = glm::dvec2(0.5, 0.6);
    slices.push_back(slice);
  }
  return slices;
}

glm::dvec3 normal_of(const imaging::SliceHeader& slice) {
  return glm::cross((*slice.orientation)[0], (*slice.orientation)[1]);
}

}  // namespace

class SeriesGeometryTest : public QObject {
  Q_OBJECT

  static void verify_refused(const std::vector<imaging::SliceHeader>& slices, const QStringList& parts) {
    const imaging::Series series = imaging::arrange_series(slices);
    QVERIFY(!series.loadable);
    for (const QString& part : parts) {
      QVERIFY2(QString::fromStdString(series.reason).contains(part), series.reason.c_str());
    }
    QCOMPARE(series.files.size(), slices.size());
  }

 private slots:
  void shuffled_slices_are_sorted_into_a_right_handed_grid() {
    auto slices = regular(9, 1.25);
    const auto sorted = slices;
    std::shuffle(slices.begin(), slices.end(), std::mt19937(3));
    const imaging::Series series = imaging::arrange_series(slices);
    QVERIFY2(series.loadable, series.reason.c_str());
    for (std::size_t k = 0; k < sorted.size(); ++k) QCOMPARE(series.files[k], sorted[k].file);
    const Geometry& g = series.geometry;
    QCOMPARE(g.size, Index3(10, 8, 9));
    QVERIFY(glm::length(g.spacing_mm - glm::dvec3(0.5, 0.6, 1.25)) < 1e-9);
    for (const imaging::SliceHeader& slice : sorted) {
      const auto k = static_cast<double>(&slice - sorted.data());
      QVERIFY(glm::length(g.to_patient({0.0, 0.0, k}) - *slice.position_mm) < 1e-9);
    }
    QVERIFY(glm::length(glm::cross(g.direction[0], g.direction[1]) - g.direction[2]) < 1e-12);
  }

  void series_of_one_frame_of_reference_know_one_another() {
    auto slices = regular(5, 2.0);
    for (auto& slice : slices) slice.frame_of_reference_uid = "1.2.9";
    const imaging::Series one = imaging::arrange_series(slices);
    QCOMPARE(one.frame_of_reference_uid, std::string("1.2.9"));
    imaging::Catalogue catalogue;
    catalogue.series = {one, one, one, imaging::arrange_series(regular(5, 2.0))};
    catalogue.series[2].frame_of_reference_uid = "1.2.10";
    catalogue.series.push_back(catalogue.series[3]);  // two that name none share none
    QCOMPARE(catalogue.on_the_frame_of(catalogue.series[0]),
             (std::vector<const imaging::Series*>{&catalogue.series[1]}));
    QVERIFY(catalogue.on_the_frame_of(catalogue.series[2]).empty());
    QVERIFY(catalogue.on_the_frame_of(catalogue.series[3]).empty());
  }

  void slices_of_several_frames_of_reference_have_none() {
    auto slices = regular(5, 2.0);
    for (auto& slice : slices) slice.frame_of_reference_uid = "1.2.9";
    slices[3].frame_of_reference_uid = "1.2.10";
    const imaging::Series series = imaging::arrange_series(slices);
    QVERIFY(series.loadable);
    QVERIFY(series.frame_of_reference_uid.empty());
    QCOMPARE(series.warnings.size(), std::size_t{1});
    QVERIFY(series.warnings[0].find("FrameOfReferenceUID (0020,0052)") != std::string::npos);
  }

  void distances_count_along_the_normal_and_may_differ_by_the_tolerance() {
    auto slices = regular(5, 2.0);
    *slices[2].position_mm += 0.0099 * normal_of(slices[2]);
    QVERIFY(imaging::arrange_series(slices).loadable);
    *slices[2].position_mm += 0.0005 * normal_of(slices[2]);
    verify_refused(slices, {"uneven", "001", "002"});
  }

  void the_tolerance_grows_with_the_distance() {
    auto slices = regular(5, 20.0);
    *slices[2].position_mm += 0.019 * normal_of(slices[2]);
    QVERIFY(imaging::arrange_series(slices).loadable);
    *slices[2].position_mm += 0.002 * normal_of(slices[2]);
    verify_refused(slices, {"uneven"});
  }

  void missing_slices_are_counted() {
    auto slices = regular(8, 2.0);
    slices.erase(slices.begin() + 3, slices.begin() + 5);
    verify_refused(slices, {"2 slices are missing between 002 and 005", "6.000 mm", "2.000 mm"});
  }

  void drift_that_no_single_step_shows_is_refused() {
    auto slices = regular(200, 1.0);
    for (std::size_t k = 0; k < slices.size(); ++k) {
      const double late = k < 100 ? static_cast<double>(k) : static_cast<double>(200 - k);
      *slices[k].position_mm += 0.004 * late * normal_of(slices[k]);
    }
    verify_refused(slices, {"uneven"});
  }

  void a_tilted_gantry_is_corrected_and_told() {
    auto slices = regular(5, 3.0);
    for (std::size_t k = 0; k < slices.size(); ++k) {
      *slices[k].position_mm +=
          3.0 * static_cast<double>(k) * std::tan(15.0 * M_PI / 180.0) * (*slices[k].orientation)[1];
    }
    imaging::Series series = imaging::arrange_series(slices);
    QVERIFY2(series.loadable, series.reason.c_str());
    QCOMPARE(series.geometry.size, Index3(10, 14, 5));
    QVERIFY(series.changes.at(0).find("15.0 degrees") != std::string::npos);
    // The policy that makes the grid last is the one in the sentences.
    imaging::set_grid(series, {imaging::GridPolicy::Tilt::keep, imaging::GridPolicy::Gaps::refuse});
    QVERIFY(series.changes.empty());
    QCOMPARE(series.warnings.size(), std::size_t{1});
    QCOMPARE(series.geometry.size, Index3(10, 8, 5));
    imaging::set_grid(series, {});
    QVERIFY(series.warnings.empty());
    QCOMPARE(series.changes.size(), std::size_t{1});
  }

  void a_small_tilt_over_many_slices_is_noticed() {
    auto slices = regular(300, 1.0);
    for (std::size_t k = 0; k < slices.size(); ++k) {
      *slices[k].position_mm += 0.005 * static_cast<double>(k) * (*slices[k].orientation)[0];
    }
    const imaging::Series series = imaging::arrange_series(slices);
    QVERIFY2(series.loadable, series.reason.c_str());
    QVERIFY(series.changes.at(0).find("0.3 degrees") != std::string::npos);
  }

  void rounding_in_the_files_is_forgiven() {
    auto slices = regular(50, 0.7);
    for (imaging::SliceHeader& slice : slices) {
      for (int a = 0; a < 3; ++a) {
        (*slice.position_mm)[a] = std::round((*slice.position_mm)[a] * 1e3) / 1e3;
        for (auto& axis : *slice.orientation) axis[a] = std::round(axis[a] * 1e5) / 1e5;
      }
    }
    const imaging::Series series = imaging::arrange_series(slices);
    QVERIFY2(series.loadable, series.reason.c_str());
    QVERIFY(std::abs(series.geometry.spacing_mm.z - 0.7) < 1e-4);
    QVERIFY(std::abs(glm::dot(series.geometry.direction[0], series.geometry.direction[1])) < 1e-12);
  }

  void one_position_twice_is_named_and_all_twice_are_several_volumes() {
    auto slices = regular(4, 2.0);
    slices[2].position_mm = slices[1].position_mm;
    verify_refused(slices, {"001 and 002 lie at the same position"});

    auto twice = regular(4, 2.0);
    for (imaging::SliceHeader slice : regular(4, 2.0)) {
      slice.sop_instance_uid += ".1";
      slice.file += "b";
      twice.push_back(slice);
    }
    verify_refused(twice, {"2 images at each of 4 positions", "000 and 000b", "no attribute"});
  }

  // Some anonymisers write one UID into every image.
  void positions_decide_what_is_a_copy_not_uids() {
    auto slices = regular(4, 2.0);
    for (imaging::SliceHeader& slice : slices) slice.sop_instance_uid = "1.2.3.0";
    const imaging::Series series = imaging::arrange_series(slices);
    QVERIFY2(series.loadable, series.reason.c_str());
    slices[3].position_mm = slices[2].position_mm;
    verify_refused(slices, {"002 and 003 are the same image"});
  }

  void a_localizer_among_slices_is_named() {
    auto slices = regular(5, 2.0);
    std::swap((*slices[3].orientation)[0], (*slices[3].orientation)[1]);
    verify_refused(slices, {"orientation", "003 differs from 000"});
    auto sizes = regular(5, 2.0);
    sizes[0].rows = 16;
    sizes[4].rows = 16;
    verify_refused(sizes, {"size", "000 and 004 differ from 001"});
    auto spacings = regular(5, 2.0);
    spacings[1].pixel_spacing_mm = glm::dvec2(0.6, 0.6);
    verify_refused(spacings, {"PixelSpacing", "001 differs from 000"});
  }

  void copies_in_other_folders_make_other_series() {
    auto slices = regular(4, 2.0);
    for (imaging::SliceHeader slice : regular(4, 2.0)) {
      slice.file = "copy" / slice.file.filename();
      slices.push_back(slice);
    }
    const auto apart = imaging::group_series(slices);
    QCOMPARE(apart.size(), std::size_t{2});
    for (const imaging::Series& series : apart) QVERIFY2(series.loadable, series.reason.c_str());
    // A series that is spread over folders is one.
    auto spread = regular(4, 2.0);
    spread[2].file = "elsewhere/002";
    const auto one = imaging::group_series(spread);
    QCOMPARE(one.size(), std::size_t{1});
    QVERIFY2(one[0].loadable, one[0].reason.c_str());
  }

  void images_without_a_series_belong_to_their_folder() {
    auto slices = regular(3, 2.0);
    for (imaging::SliceHeader& slice : slices) slice.series_uid.clear();
    const auto series = imaging::group_series(slices);
    QCOMPARE(series.size(), std::size_t{1});
    QVERIFY2(series[0].loadable, series[0].reason.c_str());
    QCOMPARE(series[0].uid, std::string("folder"));
    QVERIFY(!series[0].changes.empty());
  }

  void the_scalar_type_holds_every_slice() {
    auto slices = regular(3, 2.0);
    QCOMPARE(imaging::arrange_series(slices).scalar, std::string("uint16"));
    slices[1].is_signed = true;
    QCOMPARE(imaging::arrange_series(slices).scalar, std::string("float"));
    for (imaging::SliceHeader& slice : slices) slice.bits_stored = 12;
    QCOMPARE(imaging::arrange_series(slices).scalar, std::string("int16"));
    slices[1].intercept = 1.0;
    QCOMPARE(imaging::arrange_series(slices).scalar, std::string("float"));
  }

  void decimal_strings_are_parsed_whatever_the_locale() {
    QCOMPARE(imaging::parse_decimals("1.5"), std::vector{1.5});
    QCOMPARE(imaging::parse_decimals(" -1.5\\+2e-3 \\ .5"), (std::vector{-1.5, 2e-3, 0.5}));
    QCOMPARE(imaging::parse_decimals(std::string_view("7\0", 2)), std::vector{7.0});
    for (const char* bad :
         {"", "\\", "1\\", "1,5", "1.5mm", "0x10", "nan", "inf", "1e400", "--1", "+-1", "1 2"}) {
      QVERIFY2(!imaging::parse_decimals(bad), bad);
    }
    QCOMPARE(imaging::parse_integers("12\\-3"), (std::vector<long long>{12, -3}));
    for (const char* bad : {"", "1.0", "1A", "99999999999999999999"})
      QVERIFY2(!imaging::parse_integers(bad), bad);
  }
};

TIDEMARK_TEST(SeriesGeometryTest)

}  // namespace tidemark::test::series_geometry_test

#include "series_geometry_test.moc"
