// Speed by the mean brightnesses inside and outside of the surface.
#include "speed_functions.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::region_speed_test {

using namespace tidemark::solver;

namespace {

constexpr double kBand = 2.5;

SpeedInputs inputs_of(std::shared_ptr<const Volume> source) {
  SpeedInputs inputs;
  inputs.source = std::move(source);
  return inputs;
}

Function ball(const Geometry& geometry, double radius, glm::dvec3 shift = glm::dvec3(0.0)) {
  const glm::dvec3 centre = centre_of(geometry) + shift;
  return [=](glm::dvec3 p) { return radius - glm::distance(p, centre); };
}

Field phi_of(const Geometry& geometry, const Function& phi, Index3 page_shape = kDefaultPageShape) {
  return Field::from_dense(geometry, sample(geometry, phi), kBand, page_shape);
}

Mask mask_of(const Geometry& geometry, const Function& phi) {
  return phi_of(geometry, phi).mask();
}

// Values without any order, the same in every run.
std::shared_ptr<const Volume> noise_on(const Geometry& geometry, double level) {
  return with_noise(volume_of(geometry, [=](glm::dvec3) { return level; }), 30.0);
}

// D by the means of the voxels around one, by plain loops.
double local_speed(const Volume& source, const Field& phi, Index3 voxel, Index3 reach) {
  double sums[2] = {0.0, 0.0};
  double counts[2] = {0.0, 0.0};
  double squares = 0.0;
  const Index3 last = source.geometry.size - Index3(1);
  for (std::int64_t z = -reach.z; z <= reach.z; ++z) {
    for (std::int64_t y = -reach.y; y <= reach.y; ++y) {
      for (std::int64_t x = -reach.x; x <= reach.x; ++x) {
        const Index3 v = glm::clamp(voxel + Index3(x, y, z), Index3(0), last);
        const double value = static_cast<double>(source.value(v));
        const int side = phi.at(v) > 0.0F ? 1 : 0;
        sums[side] += value;
        squares += value * value;
        ++counts[side];
      }
    }
  }
  if (counts[0] == 0.0 || counts[1] == 0.0) return 0.0;
  const double in = sums[1] / counts[1];
  const double out = sums[0] / counts[0];
  const double mean = (sums[0] + sums[1]) / (counts[0] + counts[1]);
  const double variance = squares / (counts[0] + counts[1]) - mean * mean;
  const double i = static_cast<double>(source.value(voxel));
  const double difference = (i - out) * (i - out) - (i - in) * (i - in);
  return std::clamp(difference / std::max((in - out) * (in - out), variance), -1.0, 1.0);
}

// What a small ball grows to, in at most 1500 steps.
Field grown_from(const Geometry& geometry, const SpeedInputs& inputs, const SpeedSetting& setting,
                 const Function& start, int threads = 0) {
  auto made = make_speed(setting, inputs);
  if (!made) qFatal("%s", made.error().message.c_str());
  Parameters parameters;
  parameters.alpha = 0.7;
  ExecutorOptions options;
  options.threads = threads;
  const auto level_set = executor(ExecutorKind::host, inputs.source, parameters, options);
  set_phi(*level_set, geometry, start);
  if (const auto status = level_set->set_speed(*made); !status) qFatal("%s", status.error().message.c_str());
  run(*level_set, 1500, true);
  return level_set->snapshot().value();
}

}  // namespace

class RegionSpeedTest : public QObject {
  Q_OBJECT

 private slots:
  void the_means_are_those_of_all_voxels_on_either_side() {
    const Geometry geometry = grid({45, 38, 29}, {0.8, 0.8, 1.5});
    const auto source = with_noise(
        volume_of(geometry, [&](glm::dvec3 p) { return ball(geometry, 12.0)(p) > 0.0 ? 260.0 : 200.0; }),
        15.0);
    for (const Index3 page_shape : {kDefaultPageShape, Index3(16, 16, 1)}) {
      const Field phi = phi_of(geometry, ball(geometry, 14.0, {9.0, 3.0, 0.0}), page_shape);
      double sums[2] = {0.0, 0.0};
      double counts[2] = {0.0, 0.0};
      const Mask mask = phi.mask();
      for (std::int64_t i = 0; i < geometry.voxel_count(); ++i) {
        const int side = mask.voxels[static_cast<std::size_t>(i)];
        sums[side] += static_cast<double>(source->value(i));
        ++counts[side];
      }
      const double in = sums[1] / counts[1];
      const double out = sums[0] / counts[0];
      const auto regions = uncached(inputs_of(source), "regions")->following(phi);
      QVERIFY(regions != nullptr);
      int between = 0;
      for (std::int64_t x = 0; x < 45; ++x) {
        const double i = static_cast<double>(source->value(Index3(x, 20, 20)));
        const double d = ((i - out) * (i - out) - (i - in) * (i - in)) / ((in - out) * (in - out));
        QVERIFY(std::abs(speed_at(*regions, {x, 20, 20}) - std::clamp(d, -1.0, 1.0)) <
                3e-3);  // means are rounded
        if (std::abs(d) < 0.9) ++between;
      }
      QVERIFY(between > 10);
    }
  }

  void a_surface_on_the_border_of_two_brightnesses_has_D_1_and_minus_1() {
    const Geometry geometry = grid(Index3(24));
    const Function object = ball(geometry, 7.0);
    const auto source = volume_of(geometry, [&](glm::dvec3 p) { return object(p) > 0.0 ? 20.0 : 100.0; });
    for (const double radius : {0.0, 4.0}) {
      const auto regions =
          uncached(inputs_of(source), "regions", {{"radius", radius}})->following(phi_of(geometry, object));
      QVERIFY(std::abs(speed_at(*regions, {12, 12, 6}) - 1.0) < 1e-6);
      QVERIFY(std::abs(speed_at(*regions, {12, 12, 4}) + 1.0) < 1e-6);
    }
  }

  void without_a_surface_or_a_difference_nothing_moves() {
    const Geometry geometry = grid(Index3(24));
    const VoxelBox whole{Index3(0), geometry.size};
    const Function object = ball(geometry, 7.0);
    const auto still = [&](const SpeedFunction& function) {
      const auto all = speeds(function, whole);
      return std::all_of(all.begin(), all.end(), [](double d) { return d == 0.0; });
    };
    for (const double radius : {0.0, 4.0}) {
      const auto noise = uncached(inputs_of(noise_on(geometry, 50.0)), "regions", {{"radius", radius}});
      QVERIFY(still(*noise));
      for (const double level : {-5.0, 5.0}) {
        const auto next = noise->following(phi_of(geometry, [=](glm::dvec3) { return level; }));
        QVERIFY(next == nullptr || still(*next));
      }
      const auto constant = uncached(inputs_of(volume_of(geometry, [](glm::dvec3) { return 0.1; })),
                                     "regions", {{"radius", radius}});
      const auto next = constant->following(phi_of(geometry, object));
      QVERIFY(next == nullptr || still(*next));
    }
  }

  void means_that_stay_make_no_new_function() {
    const Geometry geometry = grid(Index3(40));
    const auto source = with_noise(
        volume_of(geometry, [&](glm::dvec3 p) { return ball(geometry, 12.0)(p) > 0.0 ? 100.0 : 0.0; }), 5.0);
    for (const double radius : {0.0, 4.0}) {
      const auto first = uncached(inputs_of(source), "regions", {{"radius", radius}});
      QVERIFY(first->follows_surface());
      const auto second = first->following(phi_of(geometry, ball(geometry, 8.0)));
      QVERIFY(second != nullptr);
      QVERIFY(second->following(phi_of(geometry, ball(geometry, 8.0))) == nullptr);
      QVERIFY(second->following(phi_of(geometry, ball(geometry, 8.0), {16, 16, 1})) == nullptr);
      QVERIFY(second->following(phi_of(geometry, ball(geometry, 9.0))) != nullptr);
      const auto through_cache = make_speed(setting_of("regions", {{"radius", radius}}), inputs_of(source));
      QVERIFY((*through_cache)->follows_surface());
      QVERIFY((*through_cache)->following(phi_of(geometry, ball(geometry, 8.0))) != nullptr);
    }
  }

  // Undo puts phi back, and a recipe does not replay what was undone.
  void the_function_depends_on_phi_alone_and_not_on_its_past() {
    const Geometry geometry = grid(Index3(40));
    const auto source = with_noise(
        volume_of(geometry, [&](glm::dvec3 p) { return ball(geometry, 12.0)(p) > 0.0 ? 100.0 : 0.0; }), 5.0);
    const VoxelBox whole{Index3(0), geometry.size};
    for (const double radius : {0.0, 4.0}) {
      const auto fresh = *make_speed(setting_of("regions", {{"radius", radius}}), inputs_of(source));
      for (const double moved : {0.02, 0.1, 0.4, 3.0}) {
        const Field phi = phi_of(geometry, ball(geometry, 8.0));
        const auto direct = fresh->following(phi);
        auto by_detour = fresh->following(phi_of(geometry, ball(geometry, 8.0 + moved, {0.3, 0.0, 0.0})));
        QVERIFY(by_detour != nullptr);
        speeds(*by_detour, whole);  // so that the cache is full
        if (auto next = by_detour->following(phi)) by_detour = next;
        QVERIFY(speeds(*by_detour, whole) == speeds(*direct, whole));
      }
    }
  }

  void local_means_are_those_of_the_box_around_the_voxel() {
    const Geometry geometry = grid({25, 22, 15}, {1.0, 1.0, 2.0});
    const auto source = noise_on(geometry, 20'000.0);
    for (const Index3 page_shape : {kDefaultPageShape, Index3(16, 16, 1)}) {
      const Field phi = phi_of(geometry, ball(geometry, 8.0, {5.0, 2.0, 1.0}), page_shape);
      const auto regions = uncached(inputs_of(source), "regions", {{"radius", 4.0}})->following(phi);
      QVERIFY(regions != nullptr);
      double largest = 0.0;
      for (std::int64_t i = 0; i < geometry.voxel_count(); i += 7) {
        const Index3 v(i % 25, i / 25 % 22, i / (25 * 22));
        const double expected = local_speed(*source, phi, v, {4, 4, 2});
        QVERIFY(std::abs(speed_at(*regions, v) - expected) < 1e-4);
        largest = std::max(largest, std::abs(expected));
      }
      QVERIFY(largest > 0.1);
    }
  }

  void a_voxel_has_the_same_bits_in_every_box() {
    const Geometry geometry = grid({25, 22, 15}, {1.0, 1.0, 2.0});
    const auto source = noise_on(geometry, 20.0);
    for (const double radius : {0.0, 3.0}) {
      const auto regions = uncached(inputs_of(source), "regions", {{"radius", radius}});
      QVERIFY(same_in_every_box(*regions->following(phi_of(geometry, ball(geometry, 8.0))), geometry.size));
    }
  }

  void a_radius_of_too_many_voxels_is_refused() {
    QCOMPARE(failure(make_speed(setting_of("regions", {{"radius", 40.0}}),
                                inputs_of(zero_volume(grid(Index3(8)))))),
             QString("the speed function regions: a radius of 40 mm is above 32 voxels; 0 is without end"));
  }

  void a_ball_in_noise_is_found_without_any_number() {
    const Geometry geometry = grid(Index3(48));
    const Function object = ball(geometry, 14.0);
    const auto source =
        with_noise(volume_of(geometry, [&](glm::dvec3 p) { return object(p) > 0.0 ? 40.0 : 10.0; }), 10.0);
    const Field found =
        grown_from(geometry, inputs_of(source), setting_of("regions"), ball(geometry, 5.0, {5.0, 4.0, 0.0}));
    const double overlap = dice(found.mask(), mask_of(geometry, object));
    QVERIFY2(overlap > 0.97, qPrintable(QString::number(overlap)));
  }

  void threads_do_not_change_a_bit() {
    const Geometry geometry = grid(Index3(40));
    const Function object = ball(geometry, 12.0);
    const auto source =
        with_noise(volume_of(geometry, [&](glm::dvec3 p) { return object(p) > 0.0 ? 40.0 : 10.0; }), 10.0);
    for (const double radius : {0.0, 4.0}) {
      const auto start = ball(geometry, 8.0);
      const auto setting = setting_of("regions", {{"radius", radius}});
      const Field one = grown_from(geometry, inputs_of(source), setting, start, 1);
      const Field four = grown_from(geometry, inputs_of(source), setting, start, 4);
      QVERIFY(one.dense() == four.dense());
    }
  }

  void local_means_follow_a_drift_that_global_means_do_not() {
    const Geometry geometry = grid(Index3(48));
    const Function object = ball(geometry, 14.0);
    const auto source = with_noise(
        volume_of(geometry, [&](glm::dvec3 p) { return 2.0 * p.x + (object(p) > 0.0 ? 25.0 : 0.0); }), 3.0);
    const Function start = ball(geometry, 11.0);
    const Mask truth = mask_of(geometry, object);
    const auto overlap = [&](double radius) {
      const auto setting = setting_of("regions", {{"radius", radius}});
      return dice(grown_from(geometry, inputs_of(source), setting, start).mask(), truth);
    };
    const double local = overlap(5.0);
    const double global = overlap(0.0);
    qInfo("Dice %.3f with means within 5 mm, %.3f with those of the whole volume", local, global);
    QVERIFY(local > 0.95);
    QVERIFY(global < 0.85);
  }
};

TIDEMARK_TEST(RegionSpeedTest)

}  // namespace tidemark::test::region_speed_test

#include "region_speed_test.moc"
