// The randomness and the shapes that phantoms are made of, and the small phantoms.
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "imaging/phantom/folds.h"
#include "imaging/phantom/kinds.h"
#include "imaging/phantom/noise.h"
#include "imaging/phantom/shapes.h"
#include "tests/imaging/phantom/measures.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::phantom_test {

using tidemark::imaging::phantom::RandomWaves;

namespace {

constexpr double kPi = 3.141592653589793;

}  // namespace

class PhantomTest : public QObject {
  Q_OBJECT

 private slots:
  void an_unknown_kind_is_refused_by_name() {
    const auto made_up = imaging::make_phantom("teapot");
    QVERIFY(!made_up);
    QCOMPARE(made_up.error().kind, ErrorKind::usage);
    QVERIFY(failure(made_up).contains("teapot"));
    QVERIFY(failure(made_up).contains("dumbbell"));
  }

  void noise_that_is_no_number_is_refused() {
    imaging::PhantomOptions options;
    for (const double noise : {std::nan(""), std::numeric_limits<double>::infinity(), 101.0}) {
      options.noise_percent = noise;
      const auto made_noisy = imaging::make_phantom("sphere", options);
      QVERIFY(!made_noisy);
      QCOMPARE(made_noisy.error().kind, ErrorKind::usage);
    }
  }

  void a_wish_to_stop_is_heard() {
    std::stop_source source;
    Progress progress;
    progress.stop = source.get_token();
    progress.report = [&](double fraction, std::string_view) {
      if (fraction > 0.3) source.request_stop();
    };
    const auto stopped = imaging::make_phantom("sphere", {}, progress);
    QVERIFY(!stopped);
    QCOMPARE(stopped.error().kind, ErrorKind::cancelled);
  }

  void the_hash_is_the_same_on_every_machine() {
    QCOMPARE(imaging::phantom::hash(1, 0), std::uint64_t{0x5e41ab087439611eULL});
    QCOMPARE(imaging::phantom::hash(42, 123456789), std::uint64_t{0xf546b4c8800eef6fULL});
  }

  void gaussian_noise_has_mean_0_deviation_1_and_no_correlation() {
    constexpr int kCount = 1'000'000;
    double sum = 0, squares = 0, fourth = 0, products = 0, before = 0;
    for (int i = 0; i < kCount; ++i) {
      const double x = imaging::phantom::gaussian(7, static_cast<std::uint64_t>(i));
      sum += x;
      squares += x * x;
      fourth += x * x * x * x;
      products += x * before;
      before = x;
    }
    QVERIFY(std::abs(sum / kCount) < 0.004);
    QVERIFY(std::abs(squares / kCount - 1.0) < 0.006);
    QVERIFY(std::abs(fourth / kCount - 2.85) < 0.03);  // 3 - 6 / 5 / 8 for a sum of eight; 3 for a Gaussian
    QVERIFY(std::abs(products / kCount) < 0.004);
  }

  void the_wave_is_a_sine_and_its_slope_the_derivative() {
    for (double turns = -3.0; turns < 3.0; turns += 0.00137) {
      const imaging::phantom::Wave wave = imaging::phantom::wave(turns);
      QVERIFY(std::abs(wave.value - std::sin(2 * kPi * turns)) < 1e-5);
      QVERIFY(std::abs(wave.slope - 2 * kPi * std::cos(2 * kPi * turns)) < 1e-4);
    }
  }

  void a_random_field_has_the_gradient_it_says_and_deviation_1() {
    const RandomWaves field(3, 12, 20.0, 30.0);
    constexpr double kStep = 1e-3;
    double squares = 0.0;
    constexpr int kPoints = 4000;
    for (int n = 0; n < kPoints; ++n) {
      const auto index = static_cast<std::uint64_t>(3 * n);
      const glm::dvec3 p =
          400.0 * glm::dvec3(imaging::phantom::uniform(9, index), imaging::phantom::uniform(9, index + 1),
                             imaging::phantom::uniform(9, index + 2));
      const RandomWaves::Sample here = field.sample(p);
      for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 step(0.0);
        step[axis] = kStep;
        const double difference = (field.value(p + step) - field.value(p - step)) / (2 * kStep);
        QVERIFY(std::abs(difference - here.gradient[axis]) < 0.02);
      }
      squares += here.value * here.value;
    }
    QVERIFY(std::abs(squares / kPoints - 1.0) < 0.1);
  }

  void rounded_unions_keep_distances_exact_at_right_angles() {
    // Two half-spaces x < 0 and y < 0: outside the fillet the union's surface is theirs.
    QCOMPARE(imaging::phantom::round_union(5.0, 1.5, 1.0), 1.5);
    QCOMPARE(imaging::phantom::round_intersection(-4.0, -2.0, 1.0), -2.0);
    // On the fillet: a quarter circle of radius 3 about (3, 3).
    QVERIFY(std::abs(imaging::phantom::round_union(3.0 - 3.0 / std::sqrt(2.0), 3.0 - 3.0 / std::sqrt(2.0),
                                                   3.0)) < 1e-12);
  }

  void half_a_voxel_is_covered_on_the_boundary() {
    QCOMPARE(imaging::phantom::coverage(0.0), 0.5);
    QCOMPARE(imaging::phantom::coverage(-1.0), 1.0);
    QCOMPARE(imaging::phantom::coverage(1.0), 0.0);
    QCOMPARE(imaging::phantom::coverage(0.2) + imaging::phantom::coverage(-0.2), 1.0);
    QVERIFY(imaging::phantom::coverage(0.4, 1.0) < imaging::phantom::coverage(0.4, 2.0));
  }

  void folds_have_walls_where_distances_are_lengths() {
    // Around a ball of radius 90: across the surface the distance changes by a mm a mm.
    const imaging::phantom::Folds folds(5, {});
    const auto distance = [&](const glm::dvec3& p) {
      const double r = glm::length(p);
      return folds.distance(r - 90.0, 90.0 / r * p, p / r, r / 90.0);
    };
    int near = 0, good = 0;
    for (std::uint64_t n = 0; n < 60'000; ++n) {
      const glm::dvec3 random(imaging::phantom::gaussian(1, 4 * n), imaging::phantom::gaussian(1, 4 * n + 1),
                              imaging::phantom::gaussian(1, 4 * n + 2));
      const glm::dvec3 p = (78.0 + 24.0 * imaging::phantom::uniform(2, n)) / glm::length(random) * random;
      if (std::abs(distance(p)) > 1.0) continue;
      constexpr double kStep = 1e-3;
      glm::dvec3 gradient;
      for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 step(0.0);
        step[axis] = kStep;
        gradient[axis] = (distance(p + step) - distance(p - step)) / (2 * kStep);
      }
      ++near;
      if (std::abs(glm::length(gradient) - 1.0) < 0.15) ++good;
    }
    QVERIFY(near > 2000);
    QVERIFY2(good > 0.85 * near, qPrintable(QString("%1 of %2").arg(good).arg(near)));
  }

  void the_same_seed_gives_the_same_voxels_for_any_number_of_threads_data() {
    QTest::addColumn<QString>("kind");
    for (const char* kind : {"sphere", "dumbbell", "bridge"}) QTest::newRow(kind) << kind;
  }
  void the_same_seed_gives_the_same_voxels_for_any_number_of_threads() {
    QFETCH(QString, kind);
    const imaging::PhantomOptions noisy{.noise_percent = 5.0, .random_seed = 11};
    const imaging::Phantom one = made(kind.toStdString(), noisy, 1);
    QVERIFY(stored(one) == stored(made(kind.toStdString(), noisy, 3)));
    QCOMPARE(one.random_seed, std::uint64_t{11});
    const imaging::PhantomOptions other{.noise_percent = 5.0, .random_seed = 12};
    QVERIFY(stored(one) != stored(made(kind.toStdString(), other, 3)));
  }

  void noise_has_the_deviation_that_is_asked_for() {
    const imaging::Phantom clean = made("sphere");
    QCOMPARE(clean.noise_percent, 0.0);
    const imaging::Phantom noisy = made("sphere", {.noise_percent = 3.0, .random_seed = 4});
    double squares = 0.0;
    std::int64_t count = 0;
    for (std::size_t i = 0; i < stored(clean).size(); ++i) {
      if (stored(clean)[i] != 800) continue;
      const double difference = stored(noisy)[i] - stored(clean)[i];
      squares += difference * difference;
      ++count;
    }
    const double deviation = std::sqrt(squares / static_cast<double>(count));
    QVERIFY2(std::abs(deviation - 24.0) < 0.5, qPrintable(QString::number(deviation)));
  }

  void a_ball_has_the_volume_of_a_ball() {
    const imaging::Phantom sphere = made("sphere");
    const double expected = 4.0 / 3.0 * kPi * 8000.0;
    QVERIFY(std::abs(static_cast<double>(sphere.truth.count()) - expected) < 0.005 * expected);
    QCOMPARE(largest_part(sphere.truth), 1.0);
  }

  void the_bridge_leads_values_in_range_from_ball_to_ball() {
    const imaging::Phantom bridge = made("bridge");
    const Geometry& geometry = bridge.volume.geometry;
    for (std::int64_t i = 0; i < geometry.size.x; ++i) {
      if (i == 12 || i == 108) continue;  // on the very boundary
      const bool within = std::abs(bridge.volume.value({i, 32, 32}) - bridge.target) < bridge.range;
      QCOMPARE(within, i > 12 && i < 108);
    }
    // Thin: three voxels across half-way, at the most.
    int across = 0;
    for (std::int64_t j = 0; j < geometry.size.y; ++j) {
      across += std::abs(bridge.volume.value({60, j, 32}) - bridge.target) < bridge.range ? 1 : 0;
    }
    QVERIFY2(across >= 2 && across <= 3, qPrintable(QString::number(across)));
    // The truth is the ball of the seed alone.
    QCOMPARE(largest_part(bridge.truth), 1.0);
    QVERIFY(bridge.truth.count() < 34'000);
  }
};

TIDEMARK_TEST(PhantomTest)

}  // namespace tidemark::test::phantom_test

#include "phantom_test.moc"
