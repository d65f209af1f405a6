// What is known of a study's values when it is opened.
#include "engine/source_summary.h"

#include <numeric>
#include <random>

#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::source_summary_test {

namespace {

template <class Stored>
Volume noise(Index3 size, Stored low, Stored high) {
  Volume volume;
  volume.geometry.size = size;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> value(static_cast<double>(low), static_cast<double>(high));
  std::vector<Stored> voxels(static_cast<std::size_t>(volume.geometry.voxel_count()));
  for (Stored& voxel : voxels) voxel = static_cast<Stored>(value(random));
  volume.voxels = std::move(voxels);
  return volume;
}

// Values that rise by 3 a mm along x, 4 along y, 0 along z.
Volume ramp(double slope) {
  Volume volume;
  volume.geometry.size = {20, 20, 8};
  volume.geometry.spacing_mm = {2.0, 1.0, 5.0};
  volume.slope = slope;
  std::vector<std::int16_t> voxels;
  for (int k = 0; k < 8; ++k) {
    for (int j = 0; j < 20; ++j) {
      for (int i = 0; i < 20; ++i)
        voxels.push_back(static_cast<std::int16_t>(std::lround((6 * i + 4 * j) / slope)));
    }
  }
  volume.voxels = std::move(voxels);
  return volume;
}

std::int64_t sum(const std::vector<std::int64_t>& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
}

}  // namespace

class SourceSummaryTest : public QObject {
  Q_OBJECT

  // As Volume::value() would have it, one voxel after the other.
  static void verify_counts(const Volume& volume) {
    const engine::SourceSummary summary = engine::summarise(volume);
    QCOMPARE(std::pair(summary.lowest, summary.highest), volume.range());
    QCOMPARE(std::pair(summary.low, summary.high), volume.common_range());
    std::vector<std::int64_t> expected(engine::SourceSummary::kBins);
    for (const float value : volume.values()) {
      const float share = (value - summary.lowest) / (summary.highest - summary.lowest);
      ++expected[static_cast<std::size_t>(
          std::min(static_cast<int>(share * engine::SourceSummary::kBins), 255))];
    }
    QCOMPARE(summary.values, expected);
    QCOMPARE(sum(summary.value_gradient), volume.geometry.voxel_count());
  }

 private slots:
  void every_voxel_is_counted_whatever_its_type() {
    verify_counts(noise<std::int16_t>({31, 17, 9}, -32768, 32767));
    verify_counts(noise<std::uint16_t>({31, 17, 9}, 0, 65535));
    verify_counts(noise<float>({31, 17, 9}, -0.5F, 0.25F));
  }

  void slope_and_intercept_count() {
    Volume volume = noise<std::int16_t>({31, 17, 9}, -1000, 3000);
    volume.slope = 2.5;
    volume.intercept = -1024.0;
    verify_counts(volume);
    volume.slope = -0.5;
    verify_counts(volume);
  }

  void gradients_are_in_units_a_mm() {
    for (const double slope : {1.0, -0.5}) {
      const Volume volume = ramp(slope);
      for (const Index3 voxel : {Index3(0, 0, 0), Index3(7, 8, 3), Index3(19, 19, 7)}) {
        QVERIFY(std::abs(engine::gradient_magnitude(volume, voxel) - 5.0F) < 1e-5F);
      }
      QVERIFY(std::abs(engine::summarise(volume).steepest - 5.0F) < 1e-5F);
    }
  }

  void what_lies_far_beyond_the_range_is_in_the_last_bin() {
    Volume volume = noise<float>({64, 64, 64}, -1e-3F, 1e-3F);
    const std::int64_t bright = volume.geometry.offset({32, 32, 32});
    std::get<std::vector<float>>(volume.voxels)[static_cast<std::size_t>(bright)] = 3e4F;
    const engine::SourceSummary summary = engine::summarise(volume);
    constexpr std::int64_t kBins = engine::SourceSummary::kBins;
    const auto in_last_bin = [](float value, float low, float high) {
      return (value - low) / (high - low) * static_cast<float>(kBins) >= static_cast<float>(kBins - 1);
    };
    std::int64_t brightest = 0;
    std::int64_t steepest = 0;
    for (std::int64_t offset = 0; offset < volume.geometry.voxel_count(); ++offset) {
      const float slope = engine::gradient_magnitude(volume, volume.geometry.voxel_at(offset));
      brightest += in_last_bin(volume.value(offset), summary.low, summary.high) ? 1 : 0;
      steepest += in_last_bin(slope, 0.0F, summary.steepest) ? 1 : 0;
    }
    std::int64_t last_column = 0;
    std::int64_t last_row = 0;
    for (std::int64_t n = 0; n < kBins; ++n) {
      last_column += summary.value_gradient[static_cast<std::size_t>((n + 1) * kBins - 1)];
      last_row += summary.value_gradient[static_cast<std::size_t>((kBins - 1) * kBins + n)];
    }
    QCOMPARE(last_column, brightest);
    QCOMPARE(last_row, steepest);
  }

  void one_value_everywhere_is_in_the_first_bin() {
    Volume volume;
    volume.geometry.size = {4, 4, 4};
    volume.voxels = std::vector<std::uint16_t>(64, 7);
    const engine::SourceSummary summary = engine::summarise(volume);
    QCOMPARE(summary.values.front(), std::int64_t{64});
    QCOMPARE(summary.lowest, 7.0F);
    QCOMPARE(summary.highest, 7.0F);
    QVERIFY(summary.window.width > 0.0);
  }

  void the_files_own_window_comes_first() {
    Volume volume = noise<std::int16_t>({20, 20, 20}, 0, 1000);
    const WindowLevel common = engine::summarise(volume).window;
    QVERIFY(std::abs(common.centre - 500.0) < 20.0 && std::abs(common.width - 1000.0) < 30.0);
    volume.window = WindowLevel{40.0, 400.0};
    QCOMPARE(engine::summarise(volume).window, (WindowLevel{40.0, 400.0}));
  }

  void it_stops_when_it_is_told_to() {
    std::stop_source stop;
    stop.request_stop();
    for (const Volume& volume :
         {noise<std::int16_t>({20, 20, 20}, 0, 9), noise<float>({20, 20, 20}, 0.0F, 9.0F)}) {
      const engine::SourceSummary summary = engine::summarise(volume, {nullptr, stop.get_token()});
      QCOMPARE(sum(summary.values), std::int64_t{0});
      QCOMPARE(sum(summary.value_gradient), std::int64_t{0});
    }
  }

  // More of one value than a float counts to.
  void a_large_study_is_counted_to_the_last_voxel() {
    const Volume volume = noise<std::int16_t>({512, 512, 100}, 7, 7);
    const engine::SourceSummary summary = engine::summarise(volume);
    QCOMPARE(summary.values.front(), std::int64_t{512} * 512 * 100);
  }
};

TIDEMARK_TEST(SourceSummaryTest)

}  // namespace tidemark::test::source_summary_test

#include "source_summary_test.moc"
