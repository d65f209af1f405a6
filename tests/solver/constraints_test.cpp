// Walls and anchors on every executor: at once, in each step, and in every edit.
#include "solver/speed/constraints.h"

#include "settings.h"
#include "solver/distance_transform.h"
#include "solver/speed/motion_limit.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::constraints_test {

using namespace tidemark::solver;

namespace {

Mask mask_where(const Geometry& geometry, const std::function<bool(glm::dvec3)>& chosen) {
  Mask mask;
  mask.geometry = geometry;
  for (const float value : sample(geometry, [&](glm::dvec3 p) { return chosen(p) ? 1.0 : 0.0; })) {
    mask.voxels.push_back(value > 0.5F ? 1 : 0);
  }
  return mask;
}

std::int64_t inside_of(const Field& phi, const Mask& where) {
  const Mask inside = phi.mask();
  std::int64_t count = 0;
  for (std::size_t i = 0; i < where.voxels.size(); ++i) {
    if (inside.voxels[i] != 0 && where.voxels[i] != 0) ++count;
  }
  return count;
}

// The least and the greatest phi in the voxels of a mask.
std::pair<float, float> range_of(const Field& phi, const Mask& where) {
  const std::vector<float> values = phi.dense();
  std::pair<float, float> range{1e9F, -1e9F};
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (where.voxels[i] == 0) continue;
    range = {std::min(range.first, values[i]), std::max(range.second, values[i])};
  }
  return range;
}

std::shared_ptr<const Constraints> constraints_of(const Geometry& geometry, const Mask& walls,
                                                  const Mask& anchors = {}) {
  auto constraints = std::make_shared<Constraints>(geometry.size);
  if (!walls.voxels.empty()) constraints->set(BitMask(walls), Constraint::wall);
  if (!anchors.voxels.empty()) constraints->set(BitMask(anchors), Constraint::anchor);
  return constraints;
}

// Where the surface crosses a row of voxels along x in the middle of the volume.
double crossing_mm(const Field& phi) {
  const Index3 size = phi.geometry.size;
  for (std::int64_t x = 0; x + 1 < size.x; ++x) {
    const double here = static_cast<double>(phi.at({x, size.y / 2, size.z / 2}));
    const double next = static_cast<double>(phi.at({x + 1, size.y / 2, size.z / 2}));
    if (here > 0.0 && next <= 0.0)
      return (static_cast<double>(x) + here / (here - next)) * phi.geometry.spacing_mm.x;
  }
  return -1.0;
}

// D = 1 or -1 everywhere.
std::shared_ptr<const Volume> uniform_source(const Geometry& geometry, bool grows) {
  return volume_of(geometry, [grows](glm::dvec3) { return grows ? 0.0 : 1000.0; });
}

Parameters data_alone() {
  Parameters parameters;
  parameters.alpha = 1.0;
  parameters.range = 10.0;
  return parameters;
}

}  // namespace

class ConstraintsTest : public QObject {
  Q_OBJECT

 private slots:
  void a_wall_of_one_voxel_leaks_nothing_data() { add_all_rows(); }
  void a_wall_of_one_voxel_leaks_nothing() {
    const Geometry geometry = grid({30, 29, 28});
    const glm::dvec3 centre = centre_of(geometry);
    const auto distance = [&](glm::dvec3 p) { return glm::distance(p, centre); };
    const Mask wall = mask_where(geometry, [&](glm::dvec3 p) { return std::round(distance(p)) == 9.0; });
    const Mask beyond = mask_where(geometry, [&](glm::dvec3 p) { return std::round(distance(p)) > 9.0; });
    const auto level_set = this_row().make(uniform_source(geometry, true), data_alone());
    QCOMPARE(failure(level_set->set_constraints(constraints_of(geometry, wall))), QString());
    QCOMPARE(failure(level_set->paint({centre, 3.0}, Brush::add)), QString());
    run(*level_set, 2000);
    const Field phi = level_set->snapshot().value();
    QCOMPARE(inside_of(phi, wall), std::int64_t{0});
    QCOMPARE(inside_of(phi, beyond), std::int64_t{0});
    QVERIFY(range_of(phi, wall).second <= -kConstraintDepth);
    // It fills what is within.
    QCOMPARE(phi.mask().count(),
             mask_where(geometry, [&](glm::dvec3 p) { return std::round(distance(p)) < 9.0; }).count());
    QCOMPARE(failure(level_set->validate()), QString());
  }

  void anchors_stay_where_all_else_shrinks_data() { add_all_rows(); }
  void anchors_stay_where_all_else_shrinks() {
    const Geometry geometry = grid({30, 29, 28});
    const glm::dvec3 centre = centre_of(geometry);
    const Mask anchor = mask_where(
        geometry, [&](glm::dvec3 p) { return glm::distance(p, centre + glm::dvec3(2, 0, 0)) < 3.0; });
    const auto level_set = this_row().make(uniform_source(geometry, false), data_alone());
    QCOMPARE(failure(level_set->paint({centre, 9.0}, Brush::add)), QString());
    QCOMPARE(failure(level_set->set_constraints(constraints_of(geometry, {}, anchor))), QString());
    run(*level_set, 300);
    const Field phi = level_set->snapshot().value();
    QCOMPARE(phi.mask().voxels, anchor.voxels);
    QVERIFY(range_of(phi, anchor).first >= kConstraintDepth);
    QCOMPARE(failure(level_set->set_constraints(nullptr)), QString());
    run(*level_set, 100);
    QCOMPARE(level_set->snapshot().value().mask().count(), std::int64_t{0});
    QCOMPARE(failure(level_set->validate()), QString());
  }

  void a_wall_comes_and_goes_while_it_runs_data() { add_all_rows(); }
  void a_wall_comes_and_goes_while_it_runs() {
    const Geometry geometry = grid({48, 24, 24});
    const Mask wall = mask_where(geometry, [](glm::dvec3 p) { return p.x == 24.0; });
    const Mask beyond = mask_where(geometry, [](glm::dvec3 p) { return p.x >= 24.0; });
    const auto level_set = this_row().make(uniform_source(geometry, true), data_alone());
    QCOMPARE(failure(level_set->paint({{10, 12, 12}, 4.0}, Brush::add)), QString());
    run(*level_set, 10);
    QCOMPARE(failure(level_set->set_constraints(constraints_of(geometry, wall))), QString());
    run(*level_set, 300);
    QCOMPARE(inside_of(level_set->snapshot().value(), beyond), std::int64_t{0});
    QVERIFY(level_set->snapshot().value().mask().count() > 23 * 24 * 23);
    QCOMPARE(failure(level_set->set_constraints(nullptr)), QString());
    run(*level_set, 100);
    QVERIFY(inside_of(level_set->snapshot().value(), beyond) > 5000);
    QCOMPARE(failure(level_set->validate()), QString());
  }

  // In pages that have no voxels of their own, too.
  void they_hold_before_the_next_step_data() { add_all_rows(); }
  void they_hold_before_the_next_step() {
    const Geometry geometry = grid({70, 64, 60});
    const glm::dvec3 inside(40, 32, 30);
    const glm::dvec3 outside(6, 6, 5);
    const Mask wall = mask_where(geometry, [&](glm::dvec3 p) { return glm::distance(p, inside) < 2.5; });
    const Mask anchor = mask_where(geometry, [&](glm::dvec3 p) { return glm::distance(p, outside) < 2.5; });
    const auto constraints = constraints_of(geometry, wall, anchor);
    const auto level_set = this_row().make(uniform_source(geometry, true), data_alone());
    QCOMPARE(failure(level_set->paint({inside, 22.0}, Brush::add)), QString());
    const Field before = level_set->snapshot().value();
    const auto holds = [&] {
      const Field phi = level_set->snapshot().value();
      return range_of(phi, wall).second <= -kConstraintDepth &&
             range_of(phi, anchor).first >= kConstraintDepth;
    };
    QVERIFY(!holds());
    QCOMPARE(failure(level_set->set_constraints(constraints)), QString());
    QVERIFY(level_set->constraints() == constraints);
    QVERIFY(holds());
    QCOMPARE(failure(level_set->validate()), QString());
    QCOMPARE(failure(level_set->paint({inside, 6.0}, Brush::add)), QString());
    QCOMPARE(failure(level_set->paint({outside, 6.0}, Brush::erase)), QString());
    QVERIFY(holds());
    QCOMPARE(failure(level_set->restore(before)), QString());
    QVERIFY(holds());
    run(*level_set, 20);
    QVERIFY(holds());
    QCOMPARE(failure(level_set->validate()), QString());
  }

  void each_step_is_the_references_step_data() { add_rows_with_host(); }
  void each_step_is_the_references_step() {
    const Scene scene = lumpy_scene({40, 37, 29}, {0.7, 0.9, 2.1});
    const Mask wall = mask_where(scene.geometry, [](glm::dvec3 p) { return std::round(p.x / 0.7) == 26.0; });
    const Mask anchor = mask_where(scene.geometry, [](glm::dvec3 p) {
      return std::round(p.y / 0.9) == 8.0 && p.x < 12.0 && p.z > 10.0 && p.z < 40.0;
    });
    const auto constraints = constraints_of(scene.geometry, wall, anchor);
    const auto tested = this_row().make(scene.source, scene.parameters);
    const auto reference = executor(ExecutorKind::reference, scene.source, scene.parameters);
    for (Executor* level_set : {tested.get(), reference.get()}) {
      QCOMPARE(failure(level_set->set_constraints(constraints)), QString());
      QCOMPARE(failure(level_set->paint(scene.seed, Brush::add)), QString());
    }
    QVERIFY(largest_difference(*tested, *reference) < 1e-5);
    double worst = 0.0;
    for (int step = 0; step < 25; ++step) {
      QCOMPARE(failure(reference->restore(tested->snapshot().value())), QString());
      run(*tested, 1);
      run(*reference, 1);
      worst = std::max(worst, largest_difference(*tested, *reference));
    }
    qInfo("largest difference of a step: %.1e", worst);
    QVERIFY(worst < 1e-5);
    run(*tested, 100);
    run(*reference, 100);
    QVERIFY(dice(tested->snapshot().value().mask(), reference->snapshot().value().mask()) >= 0.999);
    QCOMPARE(failure(tested->validate()), QString());
  }

  // Between voxels, on either side, wherever the limit lies in a voxel.
  void a_refined_mask_moves_as_far_as_it_may_data() { add_all_rows(); }
  void a_refined_mask_moves_as_far_as_it_may() {
    const glm::dvec3 spacing(0.7, 0.9, 2.1);
    const Geometry geometry = grid({44, 20, 12}, spacing);
    constexpr std::int64_t kLast = 20;  // of the mask, along x
    const double face_mm = (kLast + 0.5) * spacing.x;
    const Mask mask = mask_where(geometry, [&](glm::dvec3 p) { return p.x < face_mm; });
    for (const bool grows : {true, false}) {
      for (const double within_mm : {0.5, 2.0, 2.3, 3.15, 5.0}) {
        const MotionLimit limit(std::make_shared<const BitMask>(mask), within_mm);
        const auto level_set = this_row().make(uniform_source(geometry, grows), data_alone());
        QCOMPARE(failure(level_set->set_constraints(limit.constraints())), QString());
        const Field start = distance_transform(mask, level_set->band(), level_set->memory().page_shape);
        QCOMPARE(failure(level_set->restore(start)), QString());
        run(*level_set, 200);
        const double moved_mm = crossing_mm(level_set->snapshot().value()) - face_mm;
        const double missing_mm = within_mm - (grows ? moved_mm : -moved_mm);
        QVERIFY2(missing_mm > -1e-5 && missing_mm < 1.5 * spacing.x / kLimitSteps,
                 qPrintable(QStringLiteral("%1 of %2 mm").arg(moved_mm).arg(within_mm)));
        QCOMPARE(failure(level_set->validate()), QString());
      }
    }
  }

  void those_of_another_grid_are_refused_data() { add_all_rows(); }
  void those_of_another_grid_are_refused() {
    const auto level_set = this_row().make(zero_volume(grid({20, 20, 20})), data_alone());
    const Status set = level_set->set_constraints(std::make_shared<Constraints>(Index3(20, 20, 21)));
    QVERIFY(!set && set.error().kind == ErrorKind::usage);
    QVERIFY(level_set->constraints() == nullptr);
  }
};

TIDEMARK_TEST(ConstraintsTest)

}  // namespace tidemark::test::constraints_test

#include "constraints_test.moc"
