// What every executor does with a speed function: D and a velocity in each step, evaluated where the surface
// comes, and anew when it follows the surface.
#include "formula_speed.h"
#include "settings.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::speed_function_test {

namespace {

// Lumps in which the surface grows and shrinks at many speeds.
double lumps(glm::dvec3 v) {
  return 0.3 + 0.9 * std::sin(v.x / 5.0) * std::cos(v.y / 4.0 + 0.5) * std::sin(v.z / 6.0 + 1.0);
}

// Around the z axis of the voxel (20, 18, 14), and along it.
glm::vec3 whirl(glm::dvec3 v) {
  const glm::dvec3 q = v - glm::dvec3(20, 18, 14);
  return {glm::dvec3(-0.03 * q.y, 0.03 * q.x, 0.2 * std::sin(q.x / 4.0))};
}
constexpr double kFastestWhirl = 1.2;

std::shared_ptr<FormulaSpeed> lumpy_speed(bool advecting) {
  return advecting ? std::make_shared<FormulaSpeed>(lumps, whirl, kFastestWhirl)
                   : std::make_shared<FormulaSpeed>(lumps);
}

// D = 1 while the surface encloses less than `limit` voxels, then -1. Counts how often it is asked to follow.
class GrowsToLimit : public FormulaSpeed {
 public:
  GrowsToLimit(double speed, std::int64_t limit, std::shared_ptr<int> asked)
      : FormulaSpeed([speed](glm::dvec3) { return speed; }),
        speed_(speed),
        limit_(limit),
        asked_(std::move(asked)) {}
  [[nodiscard]] bool follows_surface() const override { return true; }
  [[nodiscard]] std::shared_ptr<const SpeedFunction> following(const solver::Field& phi) const override {
    ++*asked_;
    const double speed = phi.mask().count() < limit_ ? 1.0 : -1.0;
    return speed == speed_ ? nullptr : std::make_shared<GrowsToLimit>(speed, limit_, asked_);
  }

 private:
  double speed_;
  std::int64_t limit_;
  std::shared_ptr<int> asked_;
};

// The middle of what is inside, in voxels, and how much it is: by shares of voxels.
glm::dvec4 middle_and_volume(const solver::Field& phi) {
  glm::dvec4 sum(0.0);
  for (std::int64_t i = 0; i < phi.geometry.voxel_count(); ++i) {
    const Index3 v = phi.geometry.voxel_at(i);
    sum += std::clamp(0.5 + static_cast<double>(phi.at(v)), 0.0, 1.0) * glm::dvec4(v, 1.0);
  }
  return {glm::dvec3(sum) / sum.w, sum.w};
}

}  // namespace

class SpeedFunctionTest : public QObject {
  Q_OBJECT

 private slots:
  void each_step_is_the_references_step_data() {
    add_rows_with_host();
    add_small_pages();
  }
  void each_step_is_the_references_step() {
    const Setting setting = this_row();
    double worst = 0.0;
    for (const glm::dvec3 spacing : {glm::dvec3(1.0), glm::dvec3(0.7, 0.9, 2.1)}) {
      for (const bool advecting : {false, true}) {
        Scene scene = lumpy_scene({40, 37, 29}, spacing);
        scene.parameters.scheme = advecting ? solver::Scheme::split : solver::Scheme::paper;
        const auto tested = setting.make(scene.source, scene.parameters);
        const auto reference = executor(solver::ExecutorKind::reference, scene.source, scene.parameters);
        for (solver::Executor* level_set : {tested.get(), reference.get()}) {
          QCOMPARE(failure(level_set->set_speed(lumpy_speed(advecting))), QString());
          QCOMPARE(failure(level_set->paint(scene.seed, solver::Brush::add)), QString());
        }
        QCOMPARE(tested->time_step(), reference->time_step());
        worst = std::max(worst, largest_difference_of_a_step(*tested, *reference, 25));
        QCOMPARE(failure(tested->validate()), QString());
      }
    }
    qInfo("largest difference of a step: %.1e", worst);
    QVERIFY(worst < 1e-5);
  }

  void it_goes_where_the_host_goes_data() { add_rows(); }
  void it_goes_where_the_host_goes() {
    const Setting setting = this_row();
    const Scene scene = lumpy_scene({61, 50, 47});
    for (const bool advecting : {false, true}) {
      const auto tested = setting.make(scene.source, scene.parameters);
      const auto host = executor(solver::ExecutorKind::host, scene.source, scene.parameters);
      for (solver::Executor* level_set : {tested.get(), host.get()}) {
        QCOMPARE(failure(level_set->paint(scene.seed, solver::Brush::add)), QString());
        run(*level_set, 20);  // by the tent
        QCOMPARE(failure(level_set->set_speed(lumpy_speed(advecting))), QString());
        run(*level_set, 80);
      }
      const Mask mask = tested->snapshot().value().mask();
      const double overlap = dice(mask, host->snapshot().value().mask());
      qInfo("Dice %.5f of %lld voxels", overlap, static_cast<long long>(mask.count()));
      QVERIFY(mask.count() > 1000);
      QVERIFY(overlap >= 0.999);
      QCOMPARE(failure(tested->validate()), QString());
    }
  }

  void any_chunking_gives_the_same_bits_data() { add_rows(); }
  void any_chunking_gives_the_same_bits() {
    const Setting setting = this_row();
    const Scene scene = lumpy_scene({45, 40, 35});
    std::vector<float> expected;
    for (const std::int64_t chunk : {120, 1, 7, 33}) {
      const auto tested = setting.make(scene.source, scene.parameters);
      QCOMPARE(failure(tested->set_speed(lumpy_speed(true))), QString());
      QCOMPARE(failure(tested->paint(scene.seed, solver::Brush::add)), QString());
      for (std::int64_t done = 0; done < 120; done += chunk) run(*tested, std::min(chunk, 120 - done));
      const std::vector<float> values = tested->snapshot().value().dense();
      if (expected.empty()) expected = values;
      QVERIFY(values == expected);
    }
  }

  // Two bytes for each voxel around the surface, sixteen more with a velocity, and the blocks with walls.
  void what_drives_the_surface_counts_in_the_budget_data() { add_rows(); }
  void what_drives_the_surface_counts_in_the_budget() {
    const Setting setting = this_row();
    const Scene scene = lumpy_scene({96, 80, 64});
    const auto free = setting.make(scene.source, scene.parameters);
    QCOMPARE(failure(free->paint(scene.seed, solver::Brush::add)), QString());
    run(*free, 3);
    const auto resident_voxels = [&] {
      const solver::MemoryReport memory = free->memory();
      return memory.resident_pages * memory.page_shape.x * memory.page_shape.y * memory.page_shape.z;
    };
    solver::ExecutorOptions options = setting.options();
    options.memory_budget_bytes = free->memory().peak_state_bytes + 12 * resident_voxels();
    const auto tested = executor(setting.kind, scene.source, scene.parameters, options);
    QCOMPARE(failure(tested->paint(scene.seed, solver::Brush::add)), QString());
    run(*tested, 3);
    const std::int64_t with_tent = tested->memory().state_bytes;
    const auto refused = tested->set_speed(lumpy_speed(true));
    QCOMPARE(refused.error().kind, ErrorKind::capability);
    QVERIFY2(failure(refused).startsWith("the surface with what drives it needs "),
             qPrintable(failure(refused)));
    QVERIFY(!tested->speed());
    QCOMPARE(tested->memory().state_bytes, with_tent);
    run(*tested, 3);
    run(*free, 3);
    QVERIFY(tested->snapshot().value().dense() == free->snapshot().value().dense());

    const std::int64_t before = free->memory().state_bytes;
    QCOMPARE(failure(free->set_speed(lumpy_speed(false))), QString());
    run(*free, 1);
    QVERIFY(free->memory().state_bytes - before >= 2 * resident_voxels());
    QCOMPARE(failure(free->set_speed(lumpy_speed(true))), QString());
    run(*free, 1);
    QVERIFY(free->memory().state_bytes - before >= 18 * resident_voxels());
    auto walls = std::make_shared<solver::Constraints>(scene.geometry.size);
    walls->set(scene.geometry, {{3.0, 3.0, 3.0}, 2.0}, solver::Constraint::wall);
    QCOMPARE(failure(free->set_constraints(walls)), QString());
    const std::int64_t with_walls = free->memory().state_bytes;
    QVERIFY(free->memory().peak_state_bytes >= with_walls);
    QCOMPARE(failure(free->set_constraints(nullptr)), QString());
    QVERIFY(with_walls - free->memory().state_bytes >= solver::Constraints::kPageVoxels);
  }

  // There a velocity takes as much in each page as phi and D do.
  void a_velocity_counts_in_the_budget_of_the_host() {
    const Scene scene = lumpy_scene({96, 80, 64});
    const auto free = executor(solver::ExecutorKind::host, scene.source, scene.parameters);
    QCOMPARE(failure(free->paint(scene.seed, solver::Brush::add)), QString());
    run(*free, 3);
    const solver::MemoryReport memory = free->memory();
    solver::ExecutorOptions options;
    options.memory_budget_bytes = (memory.state_bytes + memory.source_bytes) * 3 / 2;
    const auto tested = executor(solver::ExecutorKind::host, scene.source, scene.parameters, options);
    QCOMPARE(failure(tested->paint(scene.seed, solver::Brush::add)), QString());
    run(*tested, 3);
    const auto function = lumpy_speed(false);
    QCOMPARE(failure(tested->set_speed(function)), QString());
    QCOMPARE(failure(free->set_speed(function)), QString());
    const Status refused = tested->set_speed(lumpy_speed(true));
    QVERIFY(!refused);
    QCOMPARE(refused.error().kind, ErrorKind::capability);
    QVERIFY(tested->speed() == function);
    QCOMPARE(tested->time_step(), free->time_step());
    run(*tested, 3);
    run(*free, 3);
    QVERIFY(tested->snapshot().value().dense() == free->snapshot().value().dense());
    QCOMPARE(failure(tested->validate()), QString());
    const solver::MemoryReport after = tested->memory();
    QVERIFY(after.state_bytes + after.source_bytes <= options.memory_budget_bytes);
  }

  // There is room for D where the surface is, and none for what a run needs around it.
  void a_run_that_lacks_memory_for_its_speed_loses_nothing_data() { add_rows(); }
  void a_run_that_lacks_memory_for_its_speed_loses_nothing() {
    const Setting setting = this_row();
    const Scene scene = lumpy_scene({96, 80, 64});
    const auto free = setting.make(scene.source, scene.parameters);
    QCOMPARE(failure(free->paint(scene.seed, solver::Brush::add)), QString());
    run(*free, 3);
    const solver::MemoryReport memory = free->memory();
    const std::int64_t voxels =
        memory.resident_pages * memory.page_shape.x * memory.page_shape.y * memory.page_shape.z;
    solver::ExecutorOptions options = setting.options();
    options.memory_budget_bytes = memory.peak_state_bytes + 19 * voxels;
    const auto tested = executor(setting.kind, scene.source, scene.parameters, options);
    QCOMPARE(failure(tested->paint(scene.seed, solver::Brush::add)), QString());
    run(*tested, 3);
    QCOMPARE(failure(tested->set_speed(lumpy_speed(true))), QString());
    solver::Advance steps;
    steps.steps = 5;
    for (int attempt = 0; attempt < 2; ++attempt) {
      const auto failed = tested->advance(steps);
      QCOMPARE(failed.error().kind, ErrorKind::capability);
      QVERIFY2(failure(failed).contains("the surface with what drives it needs "),
               qPrintable(failure(failed)));
    }
    QVERIFY(tested->snapshot().value().dense() == free->snapshot().value().dense());
    QCOMPARE(failure(tested->set_speed(nullptr)), QString());
    run(*tested, 3);
    run(*free, 3);
    QVERIFY(tested->snapshot().value().dense() == free->snapshot().value().dense());
  }

  // So small that a step takes no time, and runs are long; so fast that pages are entered within them.
  void no_page_waits_for_its_speed_within_a_run_data() { add_rows(); }
  void no_page_waits_for_its_speed_within_a_run() {
    const Setting setting = this_row();
    const Geometry geometry = grid({64, 40, 40});
    solver::Parameters parameters;
    parameters.alpha = 1.0;
    std::vector<float> expected;
    for (const std::int64_t chunk : {1, 40}) {
      const auto tested = setting.make(zero_volume(geometry), parameters);
      QCOMPARE(failure(tested->set_speed(std::make_shared<FormulaSpeed>([](glm::dvec3) { return 1.0; }))),
               QString());
      QCOMPARE(failure(tested->paint({{20, 20, 20}, 2.0}, solver::Brush::add)), QString());
      for (std::int64_t done = 0; done < 40; done += chunk) run(*tested, chunk);
      const std::vector<float> values = tested->snapshot().value().dense();
      if (expected.empty()) expected = values;
      QVERIFY(values == expected);
    }
  }

  void a_flow_carries_a_sphere_along_data() { add_all_rows(); }
  void a_flow_carries_a_sphere_along() {
    const Setting setting = this_row();
    const Geometry geometry = grid({52, 44, 44});
    const glm::dvec3 direction = glm::normalize(glm::dvec3(2.0, 1.0, -0.5));
    const auto flow = std::make_shared<FormulaSpeed>([](glm::dvec3) { return 0.0; },
                                                     [&](glm::dvec3) { return glm::vec3(direction); }, 1.0);
    solver::Parameters parameters;
    parameters.alpha = 1.0;
    const auto level_set = setting.make(zero_volume(geometry), parameters);
    QCOMPARE(failure(level_set->set_speed(flow)), QString());
    const auto steps = static_cast<std::int64_t>(std::ceil(5.0 / level_set->time_step()));
    parameters.time_step_factor = 5.0 / (static_cast<double>(steps) * level_set->time_step());
    QCOMPARE(failure(level_set->set_parameters(parameters)), QString());
    const glm::dvec3 start(21, 20, 23);
    set_phi(*level_set, geometry, [&](glm::dvec3 p) { return 13.0 - glm::distance(p, start); });
    const glm::dvec4 before = middle_and_volume(level_set->snapshot().value());
    run(*level_set, steps);
    const glm::dvec4 after = middle_and_volume(level_set->snapshot().value());
    const double missed = glm::distance(glm::dvec3(after - before), 5.0 * direction);
    qInfo("missed by %.3f voxels; volume times %.4f", missed, after.w / before.w);
    QVERIFY(missed < 0.3);
    // Upwinding to the first order rounds the sphere off a little.
    QVERIFY(std::abs(after.w / before.w - 1.0) < 0.06);
    QCOMPARE(failure(level_set->validate()), QString());
  }

  void only_what_the_surface_comes_near_is_evaluated_data() { add_rows_with_host(); }
  void only_what_the_surface_comes_near_is_evaluated() {
    const Setting setting = this_row();
    const Geometry geometry = grid({160, 160, 160});
    solver::Parameters parameters;
    const auto level_set = setting.make(zero_volume(geometry), parameters);
    const auto speed = std::make_shared<FormulaSpeed>([](glm::dvec3) { return 1.0; });
    QCOMPARE(failure(level_set->set_speed(speed)), QString());
    QCOMPARE(speed->evaluated(), std::int64_t{0});
    QCOMPARE(failure(level_set->paint({centre_of(geometry), 8.0}, solver::Brush::add)), QString());
    run(*level_set, 60);
    QVERIFY(level_set->snapshot().value().mask().count() > 5000);
    const std::int64_t evaluated = speed->evaluated();
    qInfo("%lld voxels of %lld evaluated", static_cast<long long>(evaluated),
          static_cast<long long>(geometry.voxel_count()));
    QVERIFY(evaluated > 5000);
    QVERIFY(evaluated < geometry.voxel_count() / 10);
    if (setting.kind == solver::ExecutorKind::host) return;  // a cache is in front of what costs
    // Other weights need no new values.
    parameters.alpha = 0.3;
    QCOMPARE(failure(level_set->set_parameters(parameters)), QString());
    run(*level_set, 1);
    QCOMPARE(speed->evaluated(), evaluated);
  }

  void it_follows_the_surface_once_a_window_data() { add_all_rows(); }
  void it_follows_the_surface_once_a_window() {
    const Setting setting = this_row();
    const Geometry geometry = grid({40, 40, 40});
    Mask expected;
    for (const std::int64_t chunk : {96, 5}) {
      solver::Parameters parameters;
      parameters.alpha = 1.0;
      const auto level_set = setting.make(zero_volume(geometry), parameters);
      const auto asked = std::make_shared<int>(0);
      QCOMPARE(failure(level_set->set_speed(std::make_shared<GrowsToLimit>(1.0, 3000, asked))), QString());
      QCOMPARE(failure(level_set->paint({centre_of(geometry), 5.0}, solver::Brush::add)), QString());
      std::int64_t largest = 0;
      for (std::int64_t done = 0; done < 96; done += chunk) {
        run(*level_set, std::min(chunk, 96 - done));
        largest = std::max(largest, level_set->snapshot().value().mask().count());
      }
      QCOMPARE(*asked, 96 / solver::kConvergenceWindow);
      if (chunk == 5) QVERIFY2(largest >= 3000 && largest < 10000, qPrintable(QString::number(largest)));
      QVERIFY(level_set->speed() != nullptr && level_set->speed()->follows_surface());
      const Mask mask = level_set->snapshot().value().mask();
      QVERIFY(mask.count() > 300);
      if (expected.voxels.empty()) expected = mask;
      QVERIFY(mask.voxels == expected.voxels);
    }
    const auto host = executor(solver::ExecutorKind::host, zero_volume(geometry), [] {
      solver::Parameters p;
      p.alpha = 1.0;
      return p;
    }());
    QCOMPARE(failure(host->set_speed(std::make_shared<GrowsToLimit>(1.0, 3000, std::make_shared<int>(0)))),
             QString());
    QCOMPARE(failure(host->paint({centre_of(geometry), 5.0}, solver::Brush::add)), QString());
    run(*host, 96);
    QVERIFY(dice(expected, host->snapshot().value().mask()) >= 0.999);
  }

  void without_a_function_it_is_the_tent_again_data() { add_all_rows(); }
  void without_a_function_it_is_the_tent_again() {
    const Setting setting = this_row();
    const Scene scene = lumpy_scene({40, 37, 29});
    std::vector<float> results[2];
    for (const int way : {0, 1}) {
      const auto tested = setting.make(scene.source, scene.parameters);
      if (way == 1) {
        QCOMPARE(failure(tested->set_speed(lumpy_speed(true))), QString());
        QCOMPARE(failure(tested->set_speed(nullptr)), QString());
      }
      QCOMPARE(failure(tested->paint(scene.seed, solver::Brush::add)), QString());
      run(*tested, 20);
      results[way] = tested->snapshot().value().dense();
    }
    QVERIFY(results[0] == results[1]);
  }

  void a_run_goes_on_where_memory_was_short_for_a_while_data() { add_rows(); }
  void a_run_goes_on_where_memory_was_short_for_a_while() {
    const Setting setting = this_row();
    const Scene scene = lumpy_scene({61, 50, 47});
    const auto calls_left = std::make_shared<std::atomic<int>>(60000);
    const auto speed = std::make_shared<FormulaSpeed>([calls_left](glm::dvec3 v) {
      if (--*calls_left == 0) throw std::bad_alloc();
      return lumps(v);
    });
    const auto tested = setting.make(scene.source, scene.parameters);
    const auto expected = setting.make(scene.source, scene.parameters);
    QCOMPARE(failure(tested->set_speed(speed)), QString());
    QCOMPARE(failure(expected->set_speed(lumpy_speed(false))), QString());
    for (solver::Executor* level_set : {tested.get(), expected.get()}) {
      QCOMPARE(failure(level_set->paint(scene.seed, solver::Brush::add)), QString());
    }
    solver::Advance request;
    request.steps = 80;
    const auto stopped = tested->advance(request);
    QVERIFY(!stopped && stopped.error().kind == ErrorKind::capability);
    QVERIFY(tested->steps_of_last_run() < 80);
    run(*tested, 80 - tested->steps_of_last_run());
    run(*expected, 80);
    QVERIFY(tested->snapshot().value().dense() == expected->snapshot().value().dense());
  }
};

TIDEMARK_TEST(SpeedFunctionTest)

}  // namespace tidemark::test::speed_function_test

#include "speed_function_test.moc"
