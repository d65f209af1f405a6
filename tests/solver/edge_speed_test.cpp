// Growth that edges stop, and the pull of edges.
#include "speed_functions.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::edge_speed_test {

using namespace tidemark::solver;

namespace {

SpeedInputs inputs_of(std::shared_ptr<const Volume> source) {
  SpeedInputs inputs;
  inputs.source = std::move(source);
  return inputs;
}

// Bumps on a grid with thick slices.
SpeedInputs bumps() {
  return inputs_of(volume_of(grid({21, 17, 12}, {0.7, 1.0, 1.6}), [](glm::dvec3 p) {
    return 100.0 * std::sin(0.5 * p.x) * std::cos(0.4 * p.y) + 40.0 * std::sin(0.6 * p.z);
  }));
}

// A ball that is only a little brighter than what is around it, while the brightness drifts by nearly three
// times as much from side to side: no range of brightness is the ball's alone.
struct WeakBall {
  Geometry geometry = grid(Index3(48));
  double radius = 13.0;

  [[nodiscard]] double distance(glm::dvec3 p) const { return radius - glm::distance(p, centre_of(geometry)); }
  [[nodiscard]] std::shared_ptr<const Volume> source() const {
    return with_noise(
        volume_of(geometry, [&](glm::dvec3 p) { return 2.5 * p.x + (distance(p) > 0.0 ? 24.0 : 0.0); }), 1.0);
  }
  [[nodiscard]] Mask truth() const {
    Mask mask{geometry, {}};
    for (const float d : sample(geometry, [&](glm::dvec3 p) { return distance(p); })) {
      mask.voxels.push_back(d > 0.0F ? 1 : 0);
    }
    return mask;
  }
  // Dice with the truth of what grows from a small ball in its middle.
  [[nodiscard]] double overlap(const Parameters& parameters,
                               std::shared_ptr<const SpeedFunction> speed) const {
    const auto level_set = executor(ExecutorKind::host, source(), parameters);
    set_phi(*level_set, geometry, [&](glm::dvec3 p) { return distance(p) - radius + 4.0; });
    if (!level_set->set_speed(std::move(speed))) return 0.0;
    run(*level_set, 5000, true);
    return dice(level_set->snapshot()->mask(), truth());
  }
};

}  // namespace

class EdgeSpeedTest : public QObject {
  Q_OBJECT

 private slots:
  void a_ramp_of_K_per_mm_halves_the_speed() {
    const auto ramp = inputs_of(volume_of(grid({40, 30, 20}, {0.5, 0.8, 2.0}), [](glm::dvec3 p) {
      return 3.0 * p.x + 4.0 * p.y + 12.0 * p.z;  // 13 per mm
    }));
    const auto edges = uncached(ramp, "edges", {{"sigma", 1.0}, {"contrast", 13.0}, {"balloon", -0.8}});
    QVERIFY(std::abs(speed_at(*edges, {20, 15, 10}) + 0.4) < 1e-4);
    const auto flat = uncached(inputs_of(zero_volume(grid(Index3(16)))), "edges", {{"balloon", -0.8}});
    QVERIFY(std::abs(speed_at(*flat, {0, 8, 15}) + 0.8) < 1e-6);
  }

  // A step smoothed by a Gaussian has the slope of the Gaussian.
  void a_step_stops_it_as_its_smoothed_slope_says() {
    const auto step = inputs_of(
        volume_of(grid({64, 8, 8}, glm::dvec3(0.25)), [](glm::dvec3 p) { return p.x > 7.9 ? 50.0 : 0.0; }));
    const double sigma = 1.0;
    const double k = 10.0;
    const auto edges = uncached(step, "edges", {{"sigma", sigma}, {"contrast", k}});
    for (int x = 24; x < 40; ++x) {
      const double from_step = 0.25 * x - 7.875;  // half way between two voxels
      const double slope = 50.0 / (sigma * std::sqrt(2.0 * std::numbers::pi)) *
                           std::exp(-0.5 * from_step * from_step / (sigma * sigma));
      const double expected = 1.0 / (1.0 + slope * slope / (k * k));
      const double speed = speed_at(*edges, {x, 4, 4});
      QVERIFY2(std::abs(speed - expected) < 0.02,
               qPrintable(QString("%1: %2, %3").arg(x).arg(speed).arg(expected)));
    }
  }

  void a_voxel_has_the_same_bits_in_every_box() {
    const SpeedInputs inputs = bumps();
    QVERIFY(same_in_every_box(*uncached(inputs, "edges", {{"sigma", 1.3}, {"contrast", 20.0}}),
                              inputs.source->geometry.size));
  }

  // Divided by 2 g at edges, and of at most half of the attraction along each axis.
  void the_velocity_is_minus_the_gradient_of_g() {
    const SpeedInputs inputs = bumps();
    const Geometry& geometry = inputs.source->geometry;
    const auto edges = uncached(inputs, "edges", {{"contrast", 20.0}, {"attraction", 2.5}});
    QVERIFY(edges->advects());
    double fastest = 0.0;
    const auto flow = velocities(*edges, {Index3(0), geometry.size});
    for (std::int64_t z = 1; z < geometry.size.z - 1; ++z) {
      for (std::int64_t y = 1; y < geometry.size.y - 1; ++y) {
        for (std::int64_t x = 1; x < geometry.size.x - 1; ++x) {
          const glm::vec3 v = flow[static_cast<std::size_t>(geometry.offset({x, y, z}))];
          for (int axis = 0; axis < 3; ++axis) {
            Index3 step(0);
            step[axis] = 1;
            const double difference =
                speed_at(*edges, Index3(x, y, z) + step) - speed_at(*edges, Index3(x, y, z) - step);
            const double gradient = difference / (2.0 * geometry.spacing_mm[axis] / 0.7);
            const double g = speed_at(*edges, {x, y, z});
            const double expected = std::clamp(-2.5 * gradient / std::min(1.0, 2.0 * g), -1.25, 1.25);
            QVERIFY(std::abs(static_cast<double>(v[axis]) - expected) < 1e-5);
          }
          fastest = std::max(fastest, static_cast<double>(glm::length(v)));
        }
      }
    }
    QVERIFY(fastest > 0.1 && fastest <= edges->fastest_advection());
    QVERIFY(!uncached(inputs, "edges", {{"attraction", 0.0}})->advects());
  }

  void an_edge_pulls_from_both_sides() {
    const auto step =
        inputs_of(volume_of(grid({32, 8, 8}), [](glm::dvec3 p) { return p.x > 15.5 ? 50.0 : 0.0; }));
    const auto edges = uncached(step, "edges", {{"sigma", 1.0}, {"contrast", 5.0}});
    QVERIFY(velocities(*edges, {{13, 4, 4}, Index3(1)}).front().x > 0.05F);
    QVERIFY(velocities(*edges, {{18, 4, 4}, Index3(1)}).front().x < -0.05F);
  }

  // Curvature pulls inwards by (1 - alpha) 2 / R, and holds the surface that times sigma^2 inside of the
  // edge, whose own place is sigma^2 / R inside of the ball's when it is smoothed.
  void a_small_sharp_ball_is_filled_to_its_border_data() {
    QTest::addColumn<double>("radius");
    QTest::addColumn<double>("contrast");
    for (const double radius : {5.0, 8.5, 13.0}) {
      for (const double contrast : {20.0, 1000.0})
        QTest::addRow("%g voxels, %g", radius, contrast) << radius << contrast;
    }
  }
  void a_small_sharp_ball_is_filled_to_its_border() {
    QFETCH(const double, radius);
    QFETCH(const double, contrast);
    const Geometry geometry = grid(Index3(40));
    const auto depth = [&](glm::dvec3 p) { return radius - glm::distance(p, centre_of(geometry)); };
    const auto source =
        with_noise(volume_of(geometry, [&](glm::dvec3 p) { return depth(p) > 0.0 ? contrast : 0.0; }), 1.0);
    Parameters parameters;
    parameters.alpha = 0.5;
    const auto level_set = executor(ExecutorKind::host, source, parameters);
    set_phi(*level_set, geometry, [&](glm::dvec3 p) { return depth(p) - 0.3 * radius; });
    QCOMPARE(failure(level_set->set_speed(uncached(inputs_of(source), "edges"))), QString());
    run(*level_set, 2000, true);
    const auto voxels = static_cast<double>(level_set->snapshot()->mask().count());
    const double reached = std::cbrt(0.75 * voxels / std::numbers::pi);
    const double expected = radius - ((1.0 - parameters.alpha) * 2.0 + 1.0) / radius;  // sigma is 1
    qInfo("radius %.2f of %.2f, expected %.2f", reached, radius, expected);
    QVERIFY(std::abs(reached - expected) < 0.25);
  }

  void K_from_the_image_is_above_its_noise_and_below_its_edges() {
    const WeakBall ball;
    const auto edges = uncached(inputs_of(ball.source()), "edges");
    const Index3 middle = ball.geometry.size / std::int64_t{2};
    QVERIFY(speed_at(*edges, middle) > 0.5);
    QVERIFY(speed_at(*edges, middle + Index3(0, 13, 0)) < 0.25);
  }

  void a_smoothing_of_too_many_voxels_is_refused() {
    const auto fine = inputs_of(zero_volume(grid(Index3(8), glm::dvec3(0.1))));
    QCOMPARE(failure(make_speed(setting_of("edges", {{"sigma", 2.0}}), fine)),
             QString("the speed function edges: sigma of 2 mm is above 16 voxels, which are 1.6 mm here"));
    QVERIFY(failure(make_speed(setting_of("edges", {{"balloon", 1.5}}), fine))
                .contains("between -1 and 1, not 1.5"));
  }

  void a_weak_closed_edge_holds_what_no_tent_holds() {
    const WeakBall ball;
    const SpeedInputs inputs = inputs_of(ball.source());
    Parameters parameters;
    parameters.alpha = 0.5;
    const auto edges = make_speed(setting_of("edges", {{"contrast", 4.0}, {"attraction", 2.0}}), inputs);
    QCOMPARE(failure(edges), QString());
    const double held = ball.overlap(parameters, *edges);

    double best_tent = 0.0;
    for (const double range : {10.0, 15.0, 20.0, 25.0, 30.0, 40.0, 50.0}) {
      for (const double shift : {-10.0, 0.0, 10.0, 20.0}) {
        parameters.target = 2.5 * 23.5 + 24.0 + shift;
        parameters.range = range;
        best_tent = std::max(best_tent, ball.overlap(parameters, nullptr));
      }
    }
    qInfo("Dice %.3f with edges, %.3f with the best of 28 tents", held, best_tent);
    QVERIFY(held > 0.95);
    QVERIFY(best_tent < 0.85);
  }
};

TIDEMARK_TEST(EdgeSpeedTest)

}  // namespace tidemark::test::edge_speed_test

#include "edge_speed_test.moc"
