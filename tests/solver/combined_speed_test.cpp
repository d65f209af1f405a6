// Several speed functions joined into one.
#include "solver/speed/combined_speed.h"
#include "formula_speed.h"
#include "solver/speed/cached_speed.h"
#include "solver/speed/tent_speed.h"
#include "speed_functions.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::combined_speed_test {

using namespace tidemark::solver;

namespace {

// D, v and whether it follows the surface, as told.
class Told final : public SpeedFunction {
 public:
  Told(double speed, glm::vec3 velocity, bool follows)
      : speed_(speed), velocity_(velocity), follows_(follows) {}

  void evaluate(const VoxelBox& box, double* speed) const override {
    std::fill_n(speed, box.voxels(), speed_);
  }
  bool advects() const override { return velocity_ != glm::vec3(0.0F); }
  void evaluate_advection(const VoxelBox& box, glm::vec3* velocity) const override {
    std::fill_n(velocity, box.voxels(), velocity_);
  }
  double fastest_advection() const override { return static_cast<double>(glm::length(velocity_)); }
  bool follows_surface() const override { return follows_; }
  // Half of D, until that is small.
  std::shared_ptr<const SpeedFunction> following(const Field&) const override {
    return speed_ < 0.1 ? nullptr : std::make_shared<Told>(0.5 * speed_, velocity_, true);
  }

 private:
  double speed_;
  glm::vec3 velocity_;
  bool follows_;
};

std::shared_ptr<const SpeedFunction> told(double speed, glm::vec3 velocity = glm::vec3(0.0F),
                                          bool follows = false) {
  return std::make_shared<Told>(speed, velocity, follows);
}

constexpr Index3 kVoxel{1, 2, 3};

}  // namespace

class CombinedSpeedTest : public QObject {
  Q_OBJECT

 private slots:
  void the_least_of_three() {
    QCOMPARE(speed_at(CombinedSpeed({told(0.5), told(-0.25), told(0.75)}, Combine::least), kVoxel), -0.25);
  }

  void the_product_of_three_probabilities() {
    const CombinedSpeed product({told(0.5), told(0.0), told(1.0)}, Combine::product);
    QVERIFY(std::abs(speed_at(product, kVoxel) - (2.0 * 0.75 * 0.5 * 1.0 - 1.0)) < 1e-12);
    QCOMPARE(speed_at(CombinedSpeed({told(-1.0), told(1.0)}, Combine::product), kVoxel), -1.0);
  }

  void velocities_add_up() {
    const CombinedSpeed all({told(0.5, {1.0F, 0.0F, 0.0F}), told(0.5), told(0.5, {0.0F, 2.0F, 0.0F})},
                            Combine::least);
    QVERIFY(all.advects());
    QVERIFY(velocities(all, {kVoxel, Index3(1)}).front() == glm::vec3(1.0F, 2.0F, 0.0F));
    QCOMPARE(all.fastest_advection(), 3.0);
    QVERIFY(!CombinedSpeed({told(0.5), told(1.0)}, Combine::least).advects());
  }

  void those_that_follow_the_surface_do() {
    QVERIFY(!CombinedSpeed({told(0.5), told(0.4)}, Combine::least).follows_surface());
    const CombinedSpeed both({told(0.15), told(0.16, glm::vec3(0.0F), true)}, Combine::least);
    QVERIFY(both.follows_surface());
    const auto next = both.following(Field());
    QVERIFY(next != nullptr);
    QCOMPARE(speed_at(*next, kVoxel), 0.08);
    QVERIFY(next->following(Field()) == nullptr);
  }

  void another_target_changes_the_tents_alone() {
    const Geometry geometry = grid({16, 8, 8});
    const auto source = volume_of(geometry, [](glm::dvec3 p) { return 10.0 * p.x; });
    Parameters parameters;
    parameters.target = 40.0;
    parameters.range = 100.0;
    const auto counted = std::make_shared<FormulaSpeed>([](glm::dvec3) { return 0.75; });
    const auto cached = std::make_shared<CachedSpeed>(counted, geometry.size);
    const std::shared_ptr<const SpeedFunction> joined = std::make_shared<CombinedSpeed>(
        std::vector<std::shared_ptr<const SpeedFunction>>{std::make_shared<TentSpeed>(source, parameters),
                                                          cached},
        Combine::least);
    QVERIFY(std::abs(speed_at(*joined, {2, 0, 0}) - 0.75) < 1e-4);  // of the tent it would be 0.8
    const VoxelBox page{Index3(0), Index3(8)};
    (void)speeds(*joined, page);
    const auto evaluated = counted->evaluated();
    parameters.target = 70.0;
    const auto other = with_tents(joined, source, parameters);
    QCOMPARE(failure(other), QString());
    QCOMPARE(speed_at(**other, {2, 0, 0}), 0.5);
    QVERIFY(std::abs(speed_at(*joined, {2, 0, 0}) - 0.75) < 1e-4);
    QVERIFY(speeds(**other, page) != speeds(*joined, page));
    QCOMPARE(counted->evaluated(), evaluated);
    QCOMPARE(with_tents(cached, source, parameters).value(), cached);  // there is no tent in it
    parameters.data_form = DataForm::raw;
    QVERIFY(failure(with_tents(joined, source, parameters)).contains("raw form"));
  }

  // A ball that is brighter than its surroundings, and touches a bar as bright as itself by a bridge in which
  // a given map sees nothing.
  void a_map_closes_the_leak_of_regions() {
    const Geometry geometry = grid({64, 32, 32});
    const auto ball = [](glm::dvec3 p) { return 9.0 - glm::distance(p, {16.0, 16.0, 16.0}); };
    const auto bright = [&](glm::dvec3 p) {
      const bool bridge = std::hypot(p.y - 16.0, p.z - 16.0) < 4.0 && p.x > 16.0;
      return ball(p) > 0.0 || bridge || std::abs(p.x - 52.0) < 6.0;
    };
    SpeedInputs inputs;
    inputs.source =
        with_noise(volume_of(geometry, [&](glm::dvec3 p) { return bright(p) ? 50.0 : 0.0; }), 5.0);
    inputs.map = volume_of(geometry, [&](glm::dvec3 p) { return p.x < 27.0 ? 0.95 : 0.1; });
    Mask truth{geometry, {}};
    for (const float d : sample(geometry, ball)) truth.voxels.push_back(d > 0.0F ? 1 : 0);

    const auto overlap = [&](const SpeedSetting& setting) {
      const auto made = make_speed(setting, inputs);
      if (!made) qFatal("%s", made.error().message.c_str());
      Parameters parameters;
      parameters.alpha = 0.8;
      const auto level_set = executor(ExecutorKind::host, inputs.source, parameters);
      set_phi(*level_set, geometry, [&](glm::dvec3 p) { return ball(p) - 5.0; });
      if (!level_set->set_speed(*made)) return 0.0;
      run(*level_set, 1000, true);
      return dice(level_set->snapshot()->mask(), truth);
    };
    const double alone = overlap(setting_of("regions"));
    const double least = overlap({{{"regions", {}}, {"image", {}}}, Combine::least});
    const double product = overlap({{{"regions", {}}, {"image", {}}}, Combine::product});
    qInfo("Dice %.3f with regions, %.3f with the least, %.3f with the product", alone, least, product);
    QVERIFY(alone < 0.6);
    QVERIFY(least > 0.95);
    QVERIFY(product > 0.95);
  }
};

TIDEMARK_TEST(CombinedSpeedTest)

}  // namespace tidemark::test::combined_speed_test

#include "combined_speed_test.moc"
