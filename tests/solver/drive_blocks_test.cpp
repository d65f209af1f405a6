// What drives and holds the surface lies on the GPU in blocks that are filled where they are read.
#include <random>

#include "formula_speed.h"
#include "level_sets.h"
#include "solver/gl/volume_blocks.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::drive_blocks_test {

using namespace tidemark::solver;

namespace {

constexpr ExecutorKind kKinds[] = {ExecutorKind::compute, ExecutorKind::stream};

// Layers of 16 x 32 blocks, and no volume of a test in one texture.
std::shared_ptr<gpu::Device> small_device(ExecutorKind kind) {
  gpu::DeviceOptions options;
  options.version = kind == ExecutorKind::stream ? gpu::GlVersion::gl33 : gpu::GlVersion::gl45;
  options.largest_texture = 512;
  options.largest_volume_texture = 20;
  auto device = gpu::Device::create_headless(options);
  if (!device) qFatal("%s", device.error().message.c_str());
  return std::move(*device);
}

template <class Scalar>
std::shared_ptr<const Volume> stored_as(const Volume& volume) {
  auto result = std::make_shared<Volume>(volume);
  const auto& values = std::get<std::vector<float>>(volume.voxels);
  result->voxels = std::vector<Scalar>(values.begin(), values.end());
  return result;
}

// A ball that grows along a bright bar, into noise at its sides.
struct Scene {
  Geometry geometry = grid({101, 52, 43}, {1.0, 1.0, 1.5});
  std::shared_ptr<const Volume> source;
  Parameters parameters;

  Scene() {
    std::mt19937 random(7);
    auto volume = std::make_shared<Volume>(*volume_of(geometry, [&](glm::dvec3 p) {
      const double across = std::max(std::abs(p.y - 26.0), std::abs(p.z - 30.0));
      return (across < 12.0 ? 160.0 : 60.0) + static_cast<double>(random() % 40);
    }));
    volume->slope = 0.5;
    volume->intercept = -20.0;
    source = std::move(volume);
    parameters.target = 70.0;
    parameters.range = 25.0;
    parameters.alpha = 0.7;
  }

  [[nodiscard]] std::unique_ptr<Executor> start(ExecutorKind kind,
                                                const std::shared_ptr<const Volume>& volume,
                                                const std::shared_ptr<gpu::Device>& device = nullptr) const {
    ExecutorOptions options;
    options.device = device;
    auto level_set = executor(kind, volume, parameters, options);
    if (!level_set->paint({{15.0, 26.0, 30.0}, 6.0}, Brush::add)) qFatal("the start cannot be painted");
    return level_set;
  }
};

std::vector<float> phi_of(const Executor& level_set) {
  const auto phi = level_set.snapshot();
  if (!phi) qFatal("%s", phi.error().message.c_str());
  return phi->dense();
}

}  // namespace

class DriveBlocksTest : public QObject {
  Q_OBJECT

 private slots:
  void a_source_that_no_texture_holds_gives_the_same_bits_data() {
    QTest::addColumn<ExecutorKind>("kind");
    QTest::addColumn<std::shared_ptr<const Volume>>("source");
    const Scene scene;
    for (const ExecutorKind kind : kKinds) {
      const auto row = [&](const char* stored, const std::shared_ptr<const Volume>& source) {
        QTest::addRow("%s, %s", kind == ExecutorKind::stream ? "stream" : "compute", stored)
            << kind << source;
      };
      row("16 bits", stored_as<std::int16_t>(*scene.source));
      row("16 bits without a sign", stored_as<std::uint16_t>(*scene.source));
      row("floats", stored_as<float>(*scene.source));
    }
  }
  void a_source_that_no_texture_holds_gives_the_same_bits() {
    QFETCH(ExecutorKind, kind);
    QFETCH(std::shared_ptr<const Volume>, source);
    const Scene scene;
    const auto whole = scene.start(kind, source);
    const auto in_blocks = scene.start(kind, source, small_device(kind));
    const auto before = phi_of(*whole);
    QCOMPARE(whole->memory().source_bytes, std::int64_t{0});
    run(*whole, 150);
    run(*in_blocks, 150);
    const auto phi = phi_of(*whole);
    const auto inside = [](const std::vector<float>& values) {
      return std::ranges::count_if(values, [](float value) { return value > 0.0F; });
    };
    QVERIFY(inside(phi) > 4 * inside(before));  // it came far
    QVERIFY(phi == phi_of(*in_blocks));
    QVERIFY(in_blocks->memory().state_bytes >
            whole->memory().state_bytes);  // with what it read of the source
    QVERIFY(in_blocks->validate());
  }

  void walls_that_come_and_go_give_the_same_bits() {
    for (const ExecutorKind kind : kKinds) {
      const Scene scene;
      const auto whole = scene.start(kind, scene.source);
      const auto in_blocks = scene.start(kind, scene.source, small_device(kind));
      std::mt19937 random(3);
      Constraints constraints(scene.geometry.size);
      for (int edit = 0; edit < 12; ++edit) {
        const glm::dvec3 centre_mm(random() % 100, random() % 52, random() % 64);
        const auto what = static_cast<Constraint>(random() % 3);
        constraints.set(scene.geometry, {centre_mm, 2.0 + static_cast<double>(random() % 9)}, what);
        const auto set = std::make_shared<const Constraints>(constraints);
        for (const auto& level_set : {whole.get(), in_blocks.get()}) {
          QCOMPARE(failure(level_set->set_constraints(set)), QString());
          run(*level_set, 10);
        }
        const auto phi = phi_of(*in_blocks);
        QVERIFY(phi == phi_of(*whole));
        for (std::int64_t voxel = 0; voxel < scene.geometry.voxel_count(); ++voxel) {
          const float value = phi[static_cast<std::size_t>(voxel)];
          QVERIFY(limited(constraints.at(scene.geometry.voxel_at(voxel)), value) == value);
        }
      }
    }
  }

  void a_source_is_there_again_after_another_function() {
    for (const ExecutorKind kind : kKinds) {
      const Scene scene;
      const auto whole = scene.start(kind, scene.source);
      const auto in_blocks = scene.start(kind, scene.source, small_device(kind));
      const auto other =
          std::make_shared<FormulaSpeed>([](glm::dvec3 voxel) { return 0.6 - voxel.x / 60.0; });
      for (const auto& speed :
           {std::shared_ptr<const SpeedFunction>(), std::shared_ptr<const SpeedFunction>(other),
            std::shared_ptr<const SpeedFunction>()}) {
        for (const auto& level_set : {whole.get(), in_blocks.get()}) {
          QCOMPARE(failure(level_set->set_speed(speed)), QString());
          run(*level_set, 20);
        }
        QVERIFY(phi_of(*whole) == phi_of(*in_blocks));
      }
    }
  }

  void a_surface_that_grew_beyond_the_budget_goes_on_from_its_start() {
    for (const ExecutorKind kind : kKinds) {
      const Geometry geometry = grid(Index3(128));
      const auto source = volume_of(geometry, [](glm::dvec3) { return 0.0; });
      const auto speed = std::make_shared<FormulaSpeed>([](glm::dvec3) { return 1.0; },
                                                        [](glm::dvec3) { return glm::vec3(0.1F); }, 0.2);
      Parameters parameters;
      parameters.alpha = 1.0;
      const auto begin = [&](std::int64_t budget) {
        ExecutorOptions options;
        if (budget > 0) options.memory_budget_bytes = budget;
        auto level_set = executor(kind, source, parameters, options);
        if (!level_set->paint({centre_of(geometry), 10.0}, Brush::add) || !level_set->set_speed(speed))
          qFatal("the start cannot be made");
        return level_set;
      };
      const auto free = begin(0);
      run(*free, 10);
      const auto tight = begin(2 * free->memory().peak_state_bytes);
      const Field start = tight->snapshot().value();
      Advance steps;
      steps.steps = 300;
      const auto grown = tight->advance(steps);
      QVERIFY(!grown && grown.error().kind == ErrorKind::capability);
      QCOMPARE(failure(tight->restore(start)), QString());
      run(*tight, 10);
      QVERIFY(phi_of(*tight) == phi_of(*free));
    }
  }

  void walls_that_take_too_much_leave_the_former_ones() {
    for (const ExecutorKind kind : kKinds) {
      const Scene scene;
      const auto walls = [&](double radius_mm) {
        auto made = std::make_shared<Constraints>(scene.geometry.size);
        made->set(scene.geometry, {{50.0, 26.0, 30.0}, radius_mm}, Constraint::anchor);
        return made;
      };
      const auto free = scene.start(kind, scene.source);
      QCOMPARE(failure(free->set_constraints(walls(3.0))), QString());
      run(*free, 5);
      ExecutorOptions options;
      options.memory_budget_bytes = free->memory().peak_state_bytes * 2;
      const auto tight = executor(kind, scene.source, scene.parameters, options);
      QVERIFY(tight->paint({{15.0, 26.0, 30.0}, 6.0}, Brush::add));
      QCOMPARE(failure(tight->set_constraints(walls(3.0))), QString());
      run(*tight, 5);
      const auto refused = tight->set_constraints(walls(60.0));
      QVERIFY(!refused && refused.error().kind == ErrorKind::capability);
      run(*tight, 5);
      run(*free, 5);
      QVERIFY(phi_of(*tight) == phi_of(*free));
    }
  }

  // A function and its velocity that are known everywhere take what lies around the surface alone.
  void memory_follows_the_surface() {
    for (const ExecutorKind kind : kKinds) {
      const Geometry geometry = grid(Index3(192));
      const auto source = volume_of(geometry, [](glm::dvec3) { return 0.0; });
      const auto level_set = executor(kind, source, Parameters{});
      QVERIFY(level_set->paint({centre_of(geometry), 10.0}, Brush::add));
      const std::int64_t before = level_set->memory().state_bytes;
      const auto speed = std::make_shared<FormulaSpeed>([](glm::dvec3) { return 0.3; },
                                                        [](glm::dvec3) { return glm::vec3(0.1F); }, 0.2);
      QCOMPARE(failure(level_set->set_speed(speed)), QString());
      run(*level_set, 8);
      const MemoryReport memory = level_set->memory();
      const std::int64_t drive = memory.state_bytes - before;
      QVERIFY(drive >= memory.resident_pages * 512 * 18);
      QVERIFY2(drive < geometry.voxel_count() * 18 / 8, qPrintable(QString::number(drive)));
      QVERIFY(memory.peak_state_bytes >= memory.state_bytes);
    }
  }
};

TIDEMARK_TEST(DriveBlocksTest)

}  // namespace tidemark::test::drive_blocks_test

#include "drive_blocks_test.moc"
