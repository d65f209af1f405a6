// Smoothing, thresholds, connected regions.
#include <itkConnectedThresholdImageFilter.h>
#include <itkImage.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "imaging/filters/filters.h"
#include "imaging/filters/suggest_start.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::filters_test {

using tidemark::test::failure;

namespace {

Volume float_volume(Index3 size, glm::dvec3 spacing = glm::dvec3(1.0)) {
  Volume volume;
  volume.geometry.size = size;
  volume.geometry.spacing_mm = spacing;
  volume.voxels = std::vector<float>(static_cast<std::size_t>(volume.geometry.voxel_count()));
  return volume;
}

float& at(Volume& volume, Index3 voxel) {
  return std::get<std::vector<float>>(volume.voxels)[static_cast<std::size_t>(volume.geometry.offset(voxel))];
}

// Sum, mean and standard deviation (mm) along an axis of a volume taken as a density.
struct Moments {
  double sum = 0.0;
  double mean = 0.0;
  double deviation = 0.0;
};

Moments moments(const Volume& volume, int axis) {
  double sums[3] = {0.0, 0.0, 0.0};
  const Index3 size = volume.geometry.size;
  for (std::int64_t k = 0; k < size.z; ++k) {
    for (std::int64_t j = 0; j < size.y; ++j) {
      for (std::int64_t i = 0; i < size.x; ++i) {
        const Index3 voxel(i, j, k);
        const double x = static_cast<double>(voxel[axis]) * volume.geometry.spacing_mm[axis];
        const double value = static_cast<double>(volume.value(voxel));
        for (int power = 0; power < 3; ++power) sums[power] += value * std::pow(x, power);
      }
    }
  }
  const double mean = sums[1] / sums[0];
  return {sums[0], mean, std::sqrt(std::max(0.0, sums[2] / sums[0] - mean * mean))};
}

constexpr double kFat = -100.0;
constexpr double kOrgan = 60.0;

// Air, in it a cylinder of even fat, and in the middle of that two noisy balls: one of soft tissue beside the
// centre, a very noisy one in it.
Volume body_like_ct() {
  Volume volume = float_volume({64, 64, 64});
  std::mt19937 random(3);
  const auto noise = [&random](double deviation) {
    return std::normal_distribution<double>(0.0, deviation)(random);
  };
  for (std::int64_t offset = 0; offset < volume.geometry.voxel_count(); ++offset) {
    const Index3 voxel = volume.geometry.voxel_at(offset);
    const glm::dvec3 place(voxel);
    double value = -1000.0 + noise(10.0);
    if (glm::distance(glm::dvec2(place), glm::dvec2(32.0)) < 26.0) value = kFat + noise(1.0);
    if (glm::distance(place, glm::dvec3(32.0, 40.0, 32.0)) < 10.0) value = kOrgan + noise(8.0);
    if (glm::distance(place, glm::dvec3(32.0)) < 4.0) value = kOrgan + noise(60.0);
    at(volume, voxel) = static_cast<float>(value);
  }
  return volume;
}

Volume random_volume(Index3 size) {
  Volume volume = float_volume(size);
  std::mt19937 random(11);
  for (float& value : std::get<std::vector<float>>(volume.voxels)) value = static_cast<float>(random() % 100);
  return volume;
}

// ITK's own answer, through its own image.
std::vector<std::uint8_t> itk_connected_threshold(const Volume& volume, Index3 seed, float low, float high) {
  using Image = itk::Image<float, 3>;
  const auto image = Image::New();
  Image::SizeType size;
  for (unsigned axis = 0; axis < 3; ++axis) {
    size[axis] = static_cast<itk::SizeValueType>(volume.geometry.size[static_cast<int>(axis)]);
  }
  image->SetRegions(size);
  image->Allocate();
  const auto values = volume.values();
  std::copy(values.begin(), values.end(), image->GetBufferPointer());
  const auto filter = itk::ConnectedThresholdImageFilter<Image, itk::Image<std::uint8_t, 3>>::New();
  filter->SetInput(image);
  filter->SetLower(low);
  filter->SetUpper(high);
  filter->SetReplaceValue(1);
  filter->AddSeed({{seed.x, seed.y, seed.z}});
  filter->Update();
  const std::uint8_t* result = filter->GetOutput()->GetBufferPointer();
  return {result, result + values.size()};
}

}  // namespace

class FiltersTest : public QObject {
  Q_OBJECT

 private slots:
  void smoothing_spreads_a_point_to_sigma_in_millimetres_data() {
    QTest::addColumn<double>("sigma");
    for (const double sigma : {0.6, 1.0, 1.7, 2.5, 4.0}) QTest::addRow("%g mm", sigma) << sigma;
  }

  void smoothing_spreads_a_point_to_sigma_in_millimetres() {
    QFETCH(double, sigma);
    Volume volume = float_volume({61, 71, 41}, {0.8, 0.7, 1.2});
    at(volume, {30, 35, 20}) = 1000.0F;
    const auto smoothed = imaging::smooth(volume, sigma);
    QCOMPARE(failure(smoothed), QString());
    QVERIFY(smoothed->geometry == volume.geometry);
    for (int axis = 0; axis < 3; ++axis) {
      const Moments m = moments(*smoothed, axis);
      const double centre = static_cast<double>(Index3(30, 35, 20)[axis]) * volume.geometry.spacing_mm[axis];
      QVERIFY(std::abs(m.sum - 1000.0) < 5.0);
      QVERIFY(std::abs(m.mean - centre) < 0.01);
      qInfo("axis %d: %.4f mm", axis, m.deviation);
      // ITK's recursive filter is up to 4 % too narrow; a sampled Gaussian of half a voxel cannot be wide
      // enough.
      if (sigma >= 0.6 * volume.geometry.spacing_mm[axis])
        QVERIFY(std::abs(m.deviation / sigma - 1.0) < 0.04);
    }
    const auto [low, high] = smoothed->range();
    qInfo("range %g to %g", static_cast<double>(low), static_cast<double>(high));
    QVERIFY(low > -0.1F && high < 1000.0F);
  }

  void smoothing_keeps_a_constant_and_the_mean_of_thin_volumes() {
    for (const Index3 size : {Index3(1, 1, 1), Index3(9, 2, 1), Index3(3, 30, 4), Index3(40, 3, 40)}) {
      for (const double sigma : {0.3, 1.0, 3.0, 50.0}) {
        Volume volume = float_volume(size, {0.5, 1.0, 6.5});
        for (float& value : std::get<std::vector<float>>(volume.voxels)) value = 321.0F;
        const auto smoothed = imaging::smooth(volume, sigma);
        QCOMPARE(failure(smoothed), QString());
        const auto [low, high] = smoothed->range();
        QVERIFY(low > 320.9F && high < 321.1F);
      }
    }
  }

  void smoothing_acts_along_axes_too_short_for_the_recursive_filter() {
    Volume volume = float_volume({2, 3, 1});
    at(volume, {0, 0, 0}) = 1.0F;
    const auto smoothed = imaging::smooth(volume, 10.0);
    QCOMPARE(failure(smoothed), QString());
    // Far beyond the size each axis sees its first voxel, continued, on one side: half of everything.
    const auto [low, high] = smoothed->range();
    QVERIFY(low > 0.2F && high < 0.3F);
  }

  void smoothing_uses_rescaled_values() {
    Volume volume;
    volume.geometry.size = {8, 8, 8};
    volume.voxels = std::vector<std::int16_t>(512, 100);
    volume.slope = 2.0;
    volume.intercept = -50.0;
    const auto smoothed = imaging::smooth(volume, 1.0);
    QCOMPARE(failure(smoothed), QString());
    QCOMPARE(std::string(smoothed->scalar_name()), std::string("float"));
    QVERIFY(std::abs(smoothed->value(Index3(4, 4, 4)) - 150.0F) < 1e-3F);
  }

  void a_sigma_that_is_no_length_is_refused() {
    for (const double sigma :
         {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      const auto smoothed = imaging::smooth(float_volume({4, 4, 4}), sigma);
      QVERIFY(!smoothed);
      QCOMPARE(smoothed.error().kind, ErrorKind::usage);
    }
  }

  void a_threshold_includes_its_ends_and_works_on_rescaled_values() {
    Volume volume;
    volume.geometry.size = {5, 1, 1};
    volume.voxels = std::vector<std::int16_t>{0, 10, 20, 30, 40};
    volume.slope = -1.0;
    volume.intercept = 5.0;
    QVERIFY(imaging::threshold(volume, -25, -5).voxels == (std::vector<std::uint8_t>{0, 1, 1, 1, 0}));
    QCOMPARE(imaging::threshold(volume, -24.9, -5.1).count(), std::int64_t{1});
    QCOMPARE(imaging::threshold(volume, 10, 0).count(), std::int64_t{0});
  }

  void a_flood_fill_gives_what_itk_gives() {
    const Volume volume = random_volume({23, 17, 19});
    for (const float high : {20.0F, 35.0F, 60.0F}) {  // below, about and above percolation
      Index3 seed(11, 8, 9);
      while (volume.value(seed) > high) ++seed.x;
      auto mask = imaging::flood_fill(volume, seed, 0.0, static_cast<double>(high));
      QCOMPARE(failure(mask), QString());
      QVERIFY(mask->contains(volume.geometry.offset(seed)));
      const Mask bytes = mask_of(inside_of(std::make_shared<const BitMask>(std::move(*mask))));
      QVERIFY(bytes.voxels == itk_connected_threshold(volume, seed, 0.0F, high));
    }
  }

  void a_flood_fill_does_not_pass_corners() {
    Volume volume = float_volume({4, 4, 1});
    at(volume, {0, 0, 0}) = at(volume, {1, 0, 0}) = at(volume, {2, 1, 0}) = 1.0F;
    const auto mask = imaging::flood_fill(volume, {0, 0, 0}, 1, 1);
    QCOMPARE(failure(mask), QString());
    QCOMPARE(mask->count(), std::int64_t{2});
  }

  void a_seed_outside_the_volume_or_the_range_is_refused() {
    const Volume volume = float_volume({4, 4, 4});
    for (const Index3 seed : {Index3(-1, 0, 0), Index3(0, 4, 0)}) {
      const auto outside = imaging::flood_fill(volume, seed, -1, 1);
      QVERIFY(!outside);
      QCOMPARE(outside.error().kind, ErrorKind::usage);
    }
    const auto wrong_value = imaging::flood_fill(volume, {1, 2, 3}, 10, 20);
    QVERIFY(!wrong_value);
    QCOMPARE(wrong_value.error().kind, ErrorKind::usage);
    QVERIFY(wrong_value.error().message.find("(1, 2, 3)") != std::string::npos);
  }

  void in_ct_the_first_suggestion_is_soft_tissue_and_not_the_fat_that_is_more_even() {
    for (const std::string modality : {"CT", ""}) {
      Volume body = body_like_ct();
      body.modality = modality;
      const auto suggestion = imaging::suggest_start(body);
      QCOMPARE(failure(suggestion), QString());
      QVERIFY2(std::abs(suggestion->target - kOrgan) < 10.0, qPrintable(QString::number(suggestion->target)));
      QVERIFY(suggestion->range >= 30.0 && suggestion->range < kOrgan - kFat);
      // The nearest even place to the middle of the volume, which lies in the muscle's noise.
      const glm::dvec3 middle = 0.5 * glm::dvec3(body.geometry.size);
      QVERIFY(glm::distance(glm::dvec3(suggestion->voxel), middle) < 14.0);
    }
    // Other modalities: some even, bright place, whatever its values are.
    Volume bright = body_like_ct();
    bright.modality = "MR";
    QVERIFY(std::abs(imaging::suggest_start(bright)->target - kFat) < 5.0);
  }

  void a_known_target_is_where_the_suggestion_begins() {
    const Volume body = body_like_ct();
    const auto fat = imaging::suggest_start(body, {.target = kFat});
    QCOMPARE(failure(fat), QString());
    QVERIFY2(std::abs(fat->target - kFat) < 10.0, qPrintable(QString::number(fat->target)));
    const auto organ = imaging::suggest_start(body, {.target = kOrgan, .range = 20.0});
    QCOMPARE(failure(organ), QString());
    QVERIFY2(std::abs(organ->target - kOrgan) < 10.0, qPrintable(QString::number(organ->target)));
    const auto nowhere = imaging::suggest_start(body, {.target = 5000.0});
    QVERIFY(!nowhere);
    QCOMPARE(nowhere.error().kind, ErrorKind::input);
    QVERIFY(nowhere.error().message.find("5000") != std::string::npos);
  }
};

TIDEMARK_TEST(FiltersTest)

}  // namespace tidemark::test::filters_test

#include "filters_test.moc"
