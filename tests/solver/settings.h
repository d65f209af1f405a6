// Settings of executors, one a row of a test's data, and a scene for them: common duties are written once.
#pragma once

#include <QTest>

#include "gpu/device.h"
#include "level_sets.h"

namespace tidemark::test {

// One context for all tests, and its messages are watched.
inline std::shared_ptr<gpu::Device> shared_device() {
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
  solver::ExecutorKind kind;
  Index3 page_shape;

  [[nodiscard]] solver::ExecutorOptions options() const {
    solver::ExecutorOptions options;
    if (kind != solver::ExecutorKind::host) options.device = shared_device();
    options.page_shape = page_shape;
    return options;
  }
  [[nodiscard]] std::unique_ptr<solver::Executor> make(std::shared_ptr<const Volume> source,
                                                       const solver::Parameters& parameters) const {
    return executor(kind, std::move(source), parameters, options());
  }
};

// The executors on OpenGL, each with the shapes of pages that it has.
inline void add_rows() {
  QTest::addColumn<int>("kind");
  QTest::addColumn<int>("layout");
  QTest::newRow("compute, 8 x 8 x 8") << int(solver::ExecutorKind::compute) << 0;
  QTest::newRow("compute, 16 x 16 x 1") << int(solver::ExecutorKind::compute) << 1;
  QTest::newRow("stream") << int(solver::ExecutorKind::stream) << 1;
}

inline void add_rows_with_host() {
  add_rows();
  QTest::newRow("host") << int(solver::ExecutorKind::host) << 0;
}

inline void add_all_rows() {
  add_rows_with_host();
  QTest::newRow("reference") << int(solver::ExecutorKind::reference) << 0;
}

// With pages of a shape that nothing may be hard-wired to.
inline void add_small_pages() {
  QTest::newRow("compute, 4 x 4 x 4") << int(solver::ExecutorKind::compute) << 2;
}

inline Setting this_row() {
  QFETCH(int, kind);
  QFETCH(int, layout);
  constexpr Index3 kShapes[] = {{8, 8, 8}, {16, 16, 1}, {4, 4, 4}};
  return {static_cast<solver::ExecutorKind>(kind), kShapes[layout]};
}

// Until every page rests, for at most so many steps.
inline void run_until_all_rest(solver::Executor& level_set, std::int64_t most) {
  for (std::int64_t steps = 0; steps < most; steps += 100) {
    run(level_set, 100);
    const solver::MemoryReport memory = level_set.memory();
    if (memory.quiet_pages == memory.resident_pages) return;
  }
}

// The largest difference of a step from the reference's. Each step begins where the tested one stands, since
// rounding grows with the steps.
inline double largest_difference_of_a_step(solver::Executor& tested, solver::Executor& reference, int steps) {
  double worst = 0.0;
  for (int step = 0; step < steps; ++step) {
    if (const Status put = reference.restore(tested.snapshot().value()); !put)
      qFatal("%s", put.error().message.c_str());
    run(tested, 1);
    run(reference, 1);
    worst = std::max(worst, largest_difference(tested, reference));
  }
  return worst;
}

// A lumpy source, a start and parameters under which everything is in motion.
struct Scene {
  Geometry geometry;
  std::shared_ptr<const Volume> source;
  solver::Parameters parameters;
  solver::Sphere seed;
};

inline Scene lumpy_scene(Index3 size, glm::dvec3 spacing = glm::dvec3(1.0)) {
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

// The same, where a small ball is soon at rest.
inline Scene resting_scene(Index3 size) {
  Scene scene = lumpy_scene(size);
  scene.parameters.target = 95.0;
  scene.parameters.range = 15.0;
  return scene;
}

}  // namespace tidemark::test
