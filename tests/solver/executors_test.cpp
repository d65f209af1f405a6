// What every executor on OpenGL must do, row by row: the same level set as the others, page for page of its
// own.
#include "settings.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::executors_test {

class ExecutorsTest : public QObject {
  Q_OBJECT

 private slots:
  void it_agrees_with_the_reference_data() {
    add_rows();
    add_small_pages();
  }
  void it_agrees_with_the_reference() {  // T5, and anisotropy
    const Setting setting = this_row();
    for (const glm::dvec3 spacing : {glm::dvec3(1.0), glm::dvec3(0.7, 0.9, 2.1)}) {
      for (const solver::Scheme scheme : {solver::Scheme::split, solver::Scheme::paper}) {
        Scene scene = lumpy_scene({40, 37, 29}, spacing);
        scene.parameters.scheme = scheme;
        const auto tested = setting.make(scene.source, scene.parameters);
        const auto reference = executor(solver::ExecutorKind::reference, scene.source, scene.parameters);
        for (solver::Executor* level_set : {tested.get(), reference.get()}) {
          QCOMPARE(failure(level_set->paint(scene.seed, solver::Brush::add)), QString());
        }
        QVERIFY(largest_difference_of_a_step(*tested, *reference, 25) < 1e-5);
        QCOMPARE(failure(tested->validate()), QString());
      }
    }
  }

  void both_address_modes_give_the_same_bits() {
    const Scene scene = lumpy_scene({40, 37, 29}, {0.7, 0.9, 2.1});
    for (const Index3 shape : {Index3(8, 8, 8), Index3(16, 16, 1)}) {
      std::vector<float> results[2];
      for (const int shared : {0, 1}) {
        qputenv("TIDEMARK_APRON", shared != 0 ? "shared" : "columns");
        const auto tested =
            Setting{solver::ExecutorKind::compute, shape}.make(scene.source, scene.parameters);
        qunsetenv("TIDEMARK_APRON");
        QCOMPARE(failure(tested->paint(scene.seed, solver::Brush::add)), QString());
        run(*tested, 30);
        results[shared] = tested->snapshot().value().dense();
      }
      QVERIFY(results[0] == results[1]);
    }
  }

  void it_goes_where_the_host_goes_data() { add_rows(); }
  void it_goes_where_the_host_goes() {
    const Setting setting = this_row();
    const Scene scene = lumpy_scene({61, 50, 47});
    const auto tested = setting.make(scene.source, scene.parameters);
    const auto host = executor(solver::ExecutorKind::host, scene.source, scene.parameters);
    for (solver::Executor* level_set : {tested.get(), host.get()}) {
      QCOMPARE(failure(level_set->paint(scene.seed, solver::Brush::add)), QString());
      run(*level_set, 60);
      solver::Parameters other = scene.parameters;
      other.target = 70.0;
      other.alpha = 0.5;
      QCOMPARE(failure(level_set->set_parameters(other)), QString());
      run(*level_set, 40);
      QCOMPARE(
          failure(level_set->paint({scene.seed.centre_mm + glm::dvec3(9, 0, 0), 6.0}, solver::Brush::erase)),
          QString());
      run(*level_set, 40);
    }
    QVERIFY(largest_difference(*tested, *host) < 1e-3);
    const Mask mask = tested->snapshot().value().mask();
    QVERIFY(mask.count() > 1000);
    QVERIFY(dice(mask, host->snapshot().value().mask()) >= 0.999);
    QCOMPARE(failure(tested->validate()), QString());
  }

  // Who asks which pages move looks these up in the snapshot.
  void a_snapshot_has_the_pages_that_it_tells_of_data() {
    add_all_rows();
    add_small_pages();
    QTest::newRow("reference, 16 x 16 x 1") << int(solver::ExecutorKind::reference) << 1;
    QTest::newRow("reference, 4 x 4 x 4") << int(solver::ExecutorKind::reference) << 2;
  }
  void a_snapshot_has_the_pages_that_it_tells_of() {
    const Scene scene = lumpy_scene({45, 40, 35});
    const auto tested = this_row().make(scene.source, scene.parameters);
    QCOMPARE(failure(tested->paint(scene.seed, solver::Brush::add)), QString());
    run(*tested, 60);
    const auto phi = tested->snapshot();
    QCOMPARE(failure(phi), QString());
    QCOMPARE(phi->layout.page_shape(), tested->memory().page_shape);
    const auto moving = tested->moving_pages();
    QCOMPARE(failure(moving), QString());
    QVERIFY(!moving->empty());
    for (const std::int64_t page : *moving) QVERIFY(page < phi->layout.page_count());
  }

  void it_comes_to_rest_when_the_host_does_data() { add_rows(); }
  void it_comes_to_rest_when_the_host_does() {
    const Setting setting = this_row();
    const Scene scene = resting_scene({45, 40, 35});
    const auto tested = setting.make(scene.source, scene.parameters);
    const auto host = executor(solver::ExecutorKind::host, scene.source, scene.parameters);
    solver::AdvanceReport reports[2];
    int i = 0;
    for (solver::Executor* level_set : {tested.get(), host.get()}) {
      QCOMPARE(failure(level_set->paint(scene.seed, solver::Brush::add)), QString());
      reports[i] = run(*level_set, 2000, true);
      QVERIFY(reports[i].converged);
      ++i;
    }
    if (tested->memory().page_shape == host->memory().page_shape) {
      QCOMPARE(reports[0].steps, reports[1].steps);
      QVERIFY(std::abs(reports[0].surface_speed - reports[1].surface_speed) < 1e-4);
    }
    const auto steps_of_host = static_cast<double>(reports[1].steps);
    QVERIFY(std::abs(static_cast<double>(reports[0].steps) - steps_of_host) <= 0.05 * steps_of_host);
    QVERIFY(reports[0].voxel_updates > 0);
    run_until_all_rest(*tested, 4000);
    const solver::MemoryReport memory = tested->memory();
    QVERIFY(memory.resident_pages > 20);
    QCOMPARE(memory.quiet_pages, memory.resident_pages);
    QCOMPARE(run(*tested, 50).voxel_updates, std::int64_t{0});
    // And it wakes with its parameters, and where it is edited.
    QCOMPARE(failure(tested->set_parameters(scene.parameters)), QString());
    QCOMPARE(tested->memory().quiet_pages, std::int64_t{0});
    run_until_all_rest(*tested, 4000);
    QCOMPARE(run(*tested, 50).voxel_updates, std::int64_t{0});
    QCOMPARE(failure(tested->paint({scene.seed.centre_mm, 3.0}, solver::Brush::erase)), QString());
    QVERIFY(run(*tested, 5).voxel_updates > 0);
    QCOMPARE(failure(tested->validate()), QString());
  }

  void any_chunking_gives_the_same_bits_data() { add_rows(); }
  void any_chunking_gives_the_same_bits() {
    const Setting setting = this_row();
    const Scene scene = lumpy_scene({45, 40, 35});
    std::vector<float> expected;
    for (const int chunk : {84, 1, 7, 30}) {
      const auto tested = setting.make(scene.source, scene.parameters);
      QCOMPARE(failure(tested->paint(scene.seed, solver::Brush::add)), QString());
      for (int done = 0; done < 84; done += chunk) run(*tested, std::min(chunk, 84 - done));
      const std::vector<float> phi = tested->snapshot().value().dense();
      if (expected.empty()) expected = phi;
      QVERIFY(phi == expected);
    }
  }

  void a_mirrored_field_gives_a_mirrored_result_data() { add_rows(); }
  void a_mirrored_field_gives_a_mirrored_result() {  // T9
    const Setting setting = this_row();
    const Scene scene = lumpy_scene({40, 40, 40});
    const auto tested = setting.make(scene.source, scene.parameters);
    QCOMPARE(failure(tested->paint(scene.seed, solver::Brush::add)), QString());
    run(*tested, 5);
    const solver::Field start = tested->snapshot().value();
    run(*tested, 30);
    const std::vector<float> expected = tested->snapshot().value().dense();
    const std::int64_t n = 40;
    for (int axis = 0; axis < 3; ++axis) {
      const auto mirrored = [&](const std::vector<float>& values) {
        std::vector<float> result(values.size());
        for (std::int64_t i = 0; i < n * n * n; ++i) {
          Index3 v(i % n, i / n % n, i / (n * n));
          v[axis] = n - 1 - v[axis];
          result[static_cast<std::size_t>(scene.geometry.offset(v))] = values[static_cast<std::size_t>(i)];
        }
        return result;
      };
      auto source = std::make_shared<Volume>(*scene.source);
      source->voxels = mirrored(scene.source->values());
      const auto other = setting.make(source, scene.parameters);
      QCOMPARE(failure(other->restore(
                   solver::Field::from_dense(scene.geometry, mirrored(start.dense()), start.band))),
               QString());
      run(*other, 30);
      QVERIFY(mirrored(other->snapshot().value().dense()) == expected);
    }
  }

  void a_saved_level_set_goes_on_as_if_unbroken_data() { add_rows(); }
  void a_saved_level_set_goes_on_as_if_unbroken() {
    const Setting setting = this_row();
    const Scene scene = lumpy_scene({45, 40, 35});
    const auto unbroken = setting.make(scene.source, scene.parameters);
    QCOMPARE(failure(unbroken->paint(scene.seed, solver::Brush::add)), QString());
    run(*unbroken, 30);
    const solver::Field saved = unbroken->snapshot().value();
    const auto resumed = setting.make(scene.source, scene.parameters);
    QCOMPARE(failure(resumed->restore(saved)), QString());
    run(*unbroken, 30);
    run(*resumed, 30);
    QVERIFY(largest_difference(*unbroken, *resumed) < 2e-3);  // quiet pages rest at other times
    QVERIFY(dice(unbroken->snapshot().value().mask(), resumed->snapshot().value().mask()) > 0.9995);
  }

  void a_lost_context_is_survived_from_a_checkpoint_data() { add_rows(); }
  void a_lost_context_is_survived_from_a_checkpoint() {
    const Setting setting = this_row();
    constexpr std::int64_t kSteps = 8;  // each has the same checks
    const Scene scene = lumpy_scene({40, 37, 29});
    const auto unbroken = setting.make(scene.source, scene.parameters);
    QVERIFY(unbroken->paint(scene.seed, solver::Brush::add));
    run(*unbroken, 24);
    const solver::Field checkpoint = unbroken->snapshot().value();
    QVERIFY(unbroken->restore(checkpoint));
    run(*unbroken, kSteps);
    const std::vector<float> expected = unbroken->snapshot().value().dense();

    int losses = 0;
    for (int at = 1; at < 200; ++at) {
      auto device = gpu::Device::create_headless({gpu::GlVersion::gl45, false});
      QVERIFY(device);
      solver::ExecutorOptions options = setting.options();
      options.device = *device;
      (*device)->lose_at_check(at);
      // Set-up, restoring, steps and reading back may each be the stage at which it happens.
      const auto attempt = [&]() -> Result<solver::Field> {
        auto made = solver::make_executor(setting.kind, scene.source, scene.parameters, options);
        if (!made) return pass_on(made);
        TIDEMARK_TRY((*made)->restore(checkpoint));
        auto report = (*made)->advance({.steps = kSteps});
        if (!report) return pass_on(report);
        return (*made)->snapshot();
      };
      auto result = attempt();
      if (!result) {
        ++losses;
        QCOMPARE(result.error().kind, ErrorKind::capability);
        QVERIFY((*device)->lost());
        QCOMPARE((*device)->handles(), std::int64_t{0});
        if (losses % 5 != 1) continue;  // rebuilding takes a while; every stage is lost, every fifth rebuilt
        options.device = nullptr;
        result = attempt();
      }
      QVERIFY(result);
      QVERIFY(result->dense() == expected);
      if (!(*device)->lost()) break;
    }
    QVERIFY(losses > 10);
  }

  void the_driver_had_no_complaint() {  // last: after all that went before
    QCOMPARE(shared_device()->severe_messages(), std::int64_t{0});
  }
};

TIDEMARK_TEST(ExecutorsTest)

}  // namespace tidemark::test::executors_test

#include "executors_test.moc"
