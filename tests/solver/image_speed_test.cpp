// A given map as speed.
#include "speed_functions.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::image_speed_test {

using namespace tidemark::solver;

namespace {

constexpr Index3 kSize{9, 8, 7};

SpeedInputs inputs_with(const Function& map) {
  SpeedInputs inputs;
  inputs.source = zero_volume(grid(kSize));
  inputs.map = volume_of(grid(kSize), map);
  return inputs;
}

// A map that is 0.25 but for one voxel.
SpeedInputs inputs_with_voxel(double value) {
  return inputs_with([=](glm::dvec3 p) { return p == glm::dvec3(4.0, 5.0, 6.0) ? value : 0.25; });
}

}  // namespace

class ImageSpeedTest : public QObject {
  Q_OBJECT

 private slots:
  void a_probability_becomes_twice_it_less_one() {
    const auto made = make_speed(setting_of("image"), inputs_with([](glm::dvec3 p) { return p.x / 8.0; }));
    QCOMPARE(failure(made), QString());
    for (int x = 0; x < 9; ++x) QVERIFY(std::abs(speed_at(**made, {x, 1, 2}) - (x / 4.0 - 1.0)) < 1e-6);
  }

  void a_map_with_values_below_0_is_the_speed_itself() {
    const auto inputs = inputs_with([](glm::dvec3 p) { return p.x / 4.0 - 1.0; });
    const auto made = make_speed(setting_of("image"), inputs);
    QCOMPARE(failure(made), QString());
    for (int x = 0; x < 9; ++x) QVERIFY(std::abs(speed_at(**made, {x, 1, 2}) - (x / 4.0 - 1.0)) < 1e-6);
    QCOMPARE(failure(make_speed(setting_of("image", {{"form", 1.0}}), inputs)),
             QString("the map of the speed function image: voxel (0, 0, 0) is -1, not between 0 and 1"));
  }

  void a_speed_without_values_below_0_can_be_told() {
    const auto made = make_speed(setting_of("image", {{"form", 2.0}}), inputs_with_voxel(0.75));
    QCOMPARE(failure(made), QString());
    QVERIFY(std::abs(speed_at(**made, {4, 5, 6}) - 0.75) < 1e-6);
  }

  void stored_integers_are_rescaled() {
    SpeedInputs inputs;
    inputs.source = zero_volume(grid(kSize));
    auto map = std::make_shared<Volume>();
    map->geometry = grid(kSize);
    map->voxels = std::vector<std::uint16_t>(static_cast<std::size_t>(map->geometry.voxel_count()), 204);
    map->slope = 1.0 / 255.0;
    inputs.map = map;
    const auto made = make_speed(setting_of("image"), inputs);
    QCOMPARE(failure(made), QString());
    QVERIFY(std::abs(speed_at(**made, {3, 3, 3}) - 0.6) < 1e-6);
  }

  void what_is_no_map_is_refused_by_its_voxel() {
    QCOMPARE(failure(make_speed(setting_of("image"), inputs_with_voxel(std::nan("")))),
             QString("the map of the speed function image: voxel (4, 5, 6) is NaN"));
    QCOMPARE(failure(make_speed(setting_of("image"), inputs_with_voxel(1.5))),
             QString("the map of the speed function image: voxel (4, 5, 6) is 1.5, not between 0 and 1"));
    QCOMPARE(failure(make_speed(setting_of("image"), inputs_with_voxel(-1.5))),
             QString("the map of the speed function image: voxel (4, 5, 6) is -1.5, not between -1 and 1"));
    // A resampled 1 may be a little more.
    QCOMPARE(failure(make_speed(setting_of("image"), inputs_with_voxel(1.00001))), QString());
  }

  void a_map_is_needed_and_on_the_same_grid() {
    SpeedInputs inputs = inputs_with_voxel(0.5);
    inputs.source = zero_volume(grid({9, 8, 8}));
    QCOMPARE(failure(make_speed(setting_of("image"), inputs)),
             QString("the map of the speed function image has 9 x 8 x 7 voxels, the volume has 9 x 8 x 8"));
    inputs.map = nullptr;
    QCOMPARE(failure(make_speed(setting_of("image"), inputs)),
             QString("the speed function image needs a map"));
  }

  void the_surface_finds_what_the_map_says() {
    const Geometry geometry = grid(Index3(32));
    const auto ball = [&](glm::dvec3 p) { return 10.0 - glm::distance(p, centre_of(geometry)); };
    SpeedInputs inputs;
    inputs.source = zero_volume(geometry);
    inputs.map = volume_of(geometry, [&](glm::dvec3 p) { return 1.0 / (1.0 + std::exp(-2.0 * ball(p))); });
    const auto made = make_speed(setting_of("image"), inputs);
    QCOMPARE(failure(made), QString());
    Parameters parameters;
    parameters.alpha = 0.9;
    const auto level_set = executor(ExecutorKind::host, inputs.source, parameters);
    set_phi(*level_set, geometry, [&](glm::dvec3 p) { return ball(p) - 6.0; });
    QCOMPARE(failure(level_set->set_speed(*made)), QString());
    run(*level_set, 300);
    Mask truth{geometry, {}};
    for (const float d : sample(geometry, ball)) truth.voxels.push_back(d > 0.0F ? 1 : 0);
    const double overlap = dice(level_set->snapshot()->mask(), truth);
    QVERIFY2(overlap > 0.97, qPrintable(QString::number(overlap)));
  }
};

TIDEMARK_TEST(ImageSpeedTest)

}  // namespace tidemark::test::image_speed_test

#include "image_speed_test.moc"
