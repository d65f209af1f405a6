// What every executor on OpenGL must do, row by row: the same level set as the others, page for page of its
// own.
#include <QTest>
#include <numbers>
#include <random>

#include "gpu/device.h"
#include "level_sets.h"
#include "solver/reference/reference_executor.h"
#include "tests/support/support.h"

using namespace tidemark;
using namespace tidemark::test;

namespace {

// One context for all tests, and its messages are watched.
std::shared_ptr<gpu::Device> shared_device() {
  static const std::shared_ptr<gpu::Device> device = [] {
    auto made = gpu::Device::create_headless({gpu::GlVersion::gl45, true});
    if (!made) qFatal("%s", made.error().message.c_str());
    (*made)->on_message([](bool severe, const std::string& text) {
      if (severe) qWarning("OpenGL: %s", text.c_str());
    });
    return *made;
  }();
  return device;
}

struct Setting {
  ExecutorKind kind;
  Index3 page_shape;

  [[nodiscard]] ExecutorOptions options() const {
    ExecutorOptions options;
    options.device = shared_device();
    options.page_shape = page_shape;
    return options;
  }
  [[nodiscard]] std::unique_ptr<Executor> make(std::shared_ptr<const Volume> source,
                                               const Parameters& parameters) const {
    return executor(kind, std::move(source), parameters, options());
  }
};

void add_rows() {
  QTest::addColumn<int>("kind");
  QTest::addColumn<int>("layout");
  QTest::newRow("compute, 8 x 8 x 8") << int(ExecutorKind::compute) << 0;
  QTest::newRow("compute, 16 x 16 x 1") << int(ExecutorKind::compute) << 1;
  QTest::newRow("stream") << int(ExecutorKind::stream) << 1;
}

Setting this_row() {
  QFETCH(int, kind);
  QFETCH(int, layout);
  constexpr Index3 kShapes[] = {{8, 8, 8}, {16, 16, 1}, {4, 4, 4}};
  return {static_cast<ExecutorKind>(kind), kShapes[layout]};
}

// A lumpy source, a start and parameters under which everything is in motion.
struct Scene {
  Geometry geometry;
  std::shared_ptr<const Volume> source;
  Parameters parameters;
  Sphere seed;
};

Scene lumpy_scene(Index3 size, glm::dvec3 spacing = glm::dvec3(1.0)) {
  Scene scene;
  scene.geometry = grid(size, spacing);
  const glm::dvec3 centre = centre_of(scene.geometry);
  scene.source = volume_of(scene.geometry, [&](glm::dvec3 p) {
    const glm::dvec3 q = p - centre;
    return 100.0 - 2.0 * glm::length(q) +
           15.0 * std::sin(q.x / 3.0) * std::sin(q.y / 4.0 + 1.0) * std::cos(q.z / 5.0);
  });
  scene.parameters.target = 85.0;
  scene.parameters.range = 30.0;
  scene.parameters.alpha = 0.7;
  scene.seed = {centre + glm::dvec3(1.3, -0.7, 0.4), 7.0};
  return scene;
}

double largest_difference(const Executor& one, const Executor& other) {
  const std::vector<float> a = one.snapshot().value().dense();
  const std::vector<float> b = other.snapshot().value().dense();
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i])));
  }
  return largest;
}

}  // namespace

class ExecutorsTest : public QObject {
  Q_OBJECT

 private slots:
  void it_agrees_with_the_reference_data() {
    add_rows();
    QTest::newRow("compute, 4 x 4 x 4") << int(ExecutorKind::compute) << 2;  // nothing is hard-wired
  }
  void it_agrees_with_the_reference() {  // T5, and anisotropy
    const Setting setting = this_row();
    for (const glm::dvec3 spacing : {glm::dvec3(1.0), glm::dvec3(0.7, 0.9, 2.1)}) {
      for (const Scheme scheme : {Scheme::split, Scheme::paper}) {
        Scene scene = lumpy_scene({40, 37, 29}, spacing);
        scene.parameters.scheme = scheme;
        const auto tested = setting.make(scene.source, scene.parameters);
        const auto reference = executor(ExecutorKind::reference, scene.source, scene.parameters);
        for (Executor* level_set : {tested.get(), reference.get()}) {
          QCOMPARE(failure(level_set->paint(scene.seed, Brush::add)), QString());
        }
        // Rounding grows with the steps; each step begins where the tested one stands.
        for (int step = 0; step < 25; ++step) {
          QCOMPARE(failure(reference->restore(tested->snapshot().value())), QString());
          run(*tested, 1);
          run(*reference, 1);
          QVERIFY(largest_difference(*tested, *reference) < 1e-5);
        }
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
        const auto tested = Setting{ExecutorKind::compute, shape}.make(scene.source, scene.parameters);
        qunsetenv("TIDEMARK_APRON");
        QCOMPARE(failure(tested->paint(scene.seed, Brush::add)), QString());
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
    const auto host = executor(ExecutorKind::host, scene.source, scene.parameters);
    for (Executor* level_set : {tested.get(), host.get()}) {
      QCOMPARE(failure(level_set->paint(scene.seed, Brush::add)), QString());
      run(*level_set, 60);
      Parameters other = scene.parameters;
      other.target = 70.0;
      other.alpha = 0.5;
      QCOMPARE(failure(level_set->set_parameters(other)), QString());
      run(*level_set, 40);
      QCOMPARE(failure(level_set->paint({scene.seed.centre_mm + glm::dvec3(9, 0, 0), 6.0}, Brush::erase)),
               QString());
      run(*level_set, 40);
    }
    QVERIFY(largest_difference(*tested, *host) < 1e-3);
    const Mask mask = tested->snapshot().value().mask();
    QVERIFY(mask.count() > 1000);
    QVERIFY(dice(mask, host->snapshot().value().mask()) >= 0.999);
    QCOMPARE(failure(tested->validate()), QString());
  }

  void it_comes_to_rest_when_the_host_does_data() { add_rows(); }
  void it_comes_to_rest_when_the_host_does() {
    const Setting setting = this_row();
    const Scene scene = lumpy_scene({61, 50, 47});
    const auto tested = setting.make(scene.source, scene.parameters);
    const auto host = executor(ExecutorKind::host, scene.source, scene.parameters);
    AdvanceReport reports[2];
    int i = 0;
    for (Executor* level_set : {tested.get(), host.get()}) {
      QCOMPARE(failure(level_set->paint(scene.seed, Brush::add)), QString());
      reports[i] = run(*level_set, 2000, true);
      QVERIFY(reports[i].converged);
      ++i;
    }
    QCOMPARE(reports[0].steps, reports[1].steps);
    QVERIFY(std::abs(reports[0].surface_speed - reports[1].surface_speed) < 1e-4);
    QVERIFY(reports[0].voxel_updates > 0);
    run(*tested, 4000);
    const MemoryReport memory = tested->memory();
    QVERIFY(memory.resident_pages > 20);
    QCOMPARE(memory.quiet_pages, memory.resident_pages);
    QCOMPARE(run(*tested, 50).voxel_updates, std::int64_t{0});
    // And an edit wakes it.
    QCOMPARE(failure(tested->paint({scene.seed.centre_mm, 3.0}, Brush::erase)), QString());
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
      QCOMPARE(failure(tested->paint(scene.seed, Brush::add)), QString());
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
    QCOMPARE(failure(tested->paint(scene.seed, Brush::add)), QString());
    run(*tested, 5);
    const Field start = tested->snapshot().value();
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
      QCOMPARE(
          failure(other->restore(Field::from_dense(scene.geometry, mirrored(start.dense()), start.band))),
          QString());
      run(*other, 30);
      QVERIFY(mirrored(other->snapshot().value().dense()) == expected);
    }
  }

  void painting_and_erasing_leak_no_page_data() { add_rows(); }
  void painting_and_erasing_leak_no_page() {  // T6
    const Setting setting = this_row();
    const Geometry geometry = grid({90, 70, 50});
    const auto source = volume_of(geometry, [](glm::dvec3 p) { return 100.0 + 40.0 * std::sin(p.x / 4.0); });
    Parameters parameters;
    parameters.target = 100.0;
    parameters.range = 30.0;
    const auto level_set = setting.make(source, parameters);
    const auto host = executor(ExecutorKind::host, source, parameters);
    std::mt19937 random(5);
    for (int edit = 0; edit < 60; ++edit) {
      const glm::dvec3 voxel(random() % 90, random() % 70, random() % 50);
      const Sphere sphere = sphere_at_voxel(geometry, voxel, 1.0 + random() % 14);
      const Brush brush = random() % 3 == 0 ? Brush::erase : Brush::add;
      const std::int64_t steps = random() % 4;
      for (Executor* each : {level_set.get(), host.get()}) {
        QCOMPARE(failure(each->paint(sphere, brush)), QString());
        run(*each, steps);
      }
      QCOMPARE(failure(level_set->validate()), QString());
    }
    QVERIFY(dice(level_set->snapshot().value().mask(), host->snapshot().value().mask()) >= 0.999);
    QVERIFY(level_set->memory().peak_resident_pages > 200);
    // Erasing everything gives every page back.
    QVERIFY(level_set->paint(sphere_at_voxel(geometry, {45, 35, 25}, 100.0), Brush::erase));
    run(*level_set, 8);
    QCOMPARE(level_set->memory().resident_pages, std::int64_t{0});
    QCOMPARE(failure(level_set->validate()), QString());
    // And filling everything leaves nothing to compute.
    QVERIFY(level_set->paint(sphere_at_voxel(geometry, {45, 35, 25}, 100.0), Brush::add));
    QCOMPARE(level_set->snapshot().value().mask().count(), geometry.voxel_count());
    QCOMPARE(failure(level_set->validate()), QString());
  }

  void painting_is_the_same_as_in_the_reference_data() { add_rows(); }
  void painting_is_the_same_as_in_the_reference() {
    const Setting setting = this_row();
    const Geometry geometry = grid({30, 26, 22}, {0.7, 0.9, 1.8});
    const auto source = zero_volume(geometry);
    const auto tested = setting.make(source, Parameters());
    const auto reference = executor(ExecutorKind::reference, source, Parameters());
    std::mt19937 random(11);
    for (int edit = 0; edit < 20; ++edit) {
      const glm::dvec3 voxel(random() % 30, random() % 26, random() % 22);
      const Sphere sphere = sphere_at_voxel(geometry, voxel, 1.0 + random() % 8);
      const Brush brush = edit % 3 == 2 ? Brush::erase : Brush::add;
      QVERIFY(tested->paint(sphere, brush));
      QVERIFY(reference->paint(sphere, brush));
    }
    QVERIFY(largest_difference(*tested, *reference) < 1e-4);
  }

  void a_saved_level_set_goes_on_as_if_unbroken_data() { add_rows(); }
  void a_saved_level_set_goes_on_as_if_unbroken() {
    const Setting setting = this_row();
    const Scene scene = lumpy_scene({45, 40, 35});
    const auto unbroken = setting.make(scene.source, scene.parameters);
    QCOMPARE(failure(unbroken->paint(scene.seed, Brush::add)), QString());
    run(*unbroken, 30);
    const Field saved = unbroken->snapshot().value();
    const auto resumed = setting.make(scene.source, scene.parameters);
    QCOMPARE(failure(resumed->restore(saved)), QString());
    run(*unbroken, 30);
    run(*resumed, 30);
    QVERIFY(largest_difference(*unbroken, *resumed) < 2e-3);  // quiet pages rest at other times
    QVERIFY(dice(unbroken->snapshot().value().mask(), resumed->snapshot().value().mask()) > 0.9995);
  }

  void padding_is_never_counted_data() { add_rows(); }
  void padding_is_never_counted() {  // T6b
    const Setting setting = this_row();
    for (const std::int64_t n : {1, 7, 61}) {
      for (int axis = 0; axis < 3; ++axis) {
        Index3 size(13, 10, 9);
        size[axis] = n;
        const Geometry geometry = grid(size);
        const auto source =
            volume_of(geometry, [](glm::dvec3 p) { return 10.0 * std::sin(p.x + p.y * 2 + p.z); });
        Parameters parameters;
        parameters.range = 5.0;
        const auto tested = setting.make(source, parameters);
        const auto reference = executor(ExecutorKind::reference, source, parameters);
        QVERIFY(tested->paint({centre_of(geometry), 4.0}, Brush::add));
        for (int step = 0; step < 4; ++step) {
          QVERIFY(reference->restore(tested->snapshot().value()));
          QVERIFY(run(*tested, 1).voxel_updates <= geometry.voxel_count());
          run(*reference, 1);
          QVERIFY(largest_difference(*tested, *reference) < 1e-5);
          QCOMPARE(failure(tested->validate()), QString());
        }
      }
    }
  }

  void the_budget_stops_the_run_and_keeps_what_was_computed_data() { add_rows(); }
  void the_budget_stops_the_run_and_keeps_what_was_computed() {  // T6
    const Setting setting = this_row();
    const Geometry geometry = grid({96, 96, 96});
    const auto source = zero_volume(geometry);
    Parameters parameters;
    parameters.alpha = 1.0;
    ExecutorOptions small = setting.options();
    small.memory_budget_bytes = 5 << 20;
    const auto limited = executor(setting.kind, source, parameters, small);
    const auto unlimited = setting.make(source, parameters);
    const Sphere sphere{centre_of(geometry), 6.0};
    QCOMPARE(failure(limited->paint(sphere, Brush::add)), QString());
    QVERIFY(unlimited->paint(sphere, Brush::add));
    int steps = 0;
    for (;; ++steps) {
      QVERIFY(steps < 500);
      run(*unlimited, 1);
      const auto report = limited->advance({});
      if (report) continue;
      QCOMPARE(report.error().kind, ErrorKind::capability);
      QVERIFY2(report.error().message.find("budget is 5 MB") != std::string::npos,
               report.error().message.c_str());
      break;
    }
    QVERIFY(steps > 5);
    QVERIFY(limited->snapshot().value().dense() == unlimited->snapshot().value().dense());
    QVERIFY(limited->memory().state_bytes <= small.memory_budget_bytes);
    // It goes on when the surface needs less.
    QCOMPARE(failure(limited->paint({centre_of(geometry), 100.0}, Brush::erase)), QString());
    run(*limited, 5);
    QCOMPARE(limited->memory().resident_pages, std::int64_t{0});
  }

  void memory_follows_the_surface_data() { add_rows(); }
  void memory_follows_the_surface() {
    const Setting setting = this_row();
    const Geometry geometry = grid({128, 128, 128});
    const auto level_set = setting.make(zero_volume(geometry), Parameters());
    set_phi(*level_set, geometry, [&](glm::dvec3 p) { return 45.0 - glm::distance(p, centre_of(geometry)); });
    const MemoryReport memory = level_set->memory();
    const auto voxels = static_cast<double>(memory.resident_pages * memory.page_shape.x *
                                            memory.page_shape.y * memory.page_shape.z);
    QVERIFY(memory.resident_pages > 300);
    QVERIFY2(static_cast<double>(memory.state_bytes) / voxels <= 10.0,
             qPrintable(QString::number(static_cast<double>(memory.state_bytes) / voxels)));
  }

  void a_lost_context_is_survived_from_a_checkpoint_data() { add_rows(); }
  void a_lost_context_is_survived_from_a_checkpoint() {
    const Setting setting = this_row();
    const Scene scene = lumpy_scene({40, 37, 29});
    const auto unbroken = setting.make(scene.source, scene.parameters);
    QVERIFY(unbroken->paint(scene.seed, Brush::add));
    run(*unbroken, 24);
    const Field checkpoint = unbroken->snapshot().value();
    QVERIFY(unbroken->restore(checkpoint));
    run(*unbroken, 24);
    const std::vector<float> expected = unbroken->snapshot().value().dense();

    int losses = 0;
    for (int at = 1; at < 200; ++at) {
      auto device = gpu::Device::create_headless({gpu::GlVersion::gl45, false});
      QVERIFY(device);
      ExecutorOptions options = setting.options();
      options.device = *device;
      (*device)->lose_at_check(at);
      // Set-up, restoring, steps and reading back may each be the stage at which it happens.
      const auto attempt = [&]() -> Result<Field> {
        auto made = make_executor(setting.kind, scene.source, scene.parameters, options);
        if (!made) return pass_on(made);
        if (auto status = (*made)->restore(checkpoint); !status) return pass_on(status);
        auto report = (*made)->advance({.steps = 24});
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

QTEST_APPLESS_MAIN(ExecutorsTest)
#include "executors_test.moc"
