#include <QtGlobal>

#include "bench/solver_bench/dense_gl.h"
#include "gpu/device.h"
#include "solver/executor.h"
#include "solver/model.h"
#include "tests/shaders/variants.h"
#include "tests/solver/formula_speed.h"

namespace tidemark::test {
namespace {

struct Driver {
  std::shared_ptr<gpu::Device> device;
  std::vector<gpu::ProgramSource>& programs;

  Driver(const Driver&) = delete;
  Driver(const gpu::DeviceOptions& options, std::vector<gpu::ProgramSource>& found) : programs(found) {
    auto made = gpu::Device::create_headless(options);
    if (!made) qFatal("%s", made.error().message.c_str());
    device = std::move(*made);
    device->on_program([this](const gpu::ProgramSource& program) -> Status {
      programs.push_back(program);
      return {};
    });
  }
};

template <class Scalar>
std::shared_ptr<const Volume> source_with(glm::dvec3 spacing) {
  auto volume = std::make_shared<Volume>();
  volume->geometry.size = {20, 18, 9};
  volume->geometry.spacing_mm = spacing;
  volume->voxels = std::vector<Scalar>(static_cast<std::size_t>(volume->geometry.voxel_count()));
  return volume;
}

template <class T>
void must(const Result<T>& result) {
  if (!result) qFatal("%s", result.error().message.c_str());
}

// All programs of an executor on a source with such a scheme.
void drive(solver::ExecutorKind kind, const std::shared_ptr<const Volume>& source, solver::Scheme scheme,
           const solver::ExecutorOptions& options) {
  solver::Constraints walls(source->geometry.size);
  walls.set({{3, 4, 5}}, solver::Constraint::wall);
  const auto constrained = std::make_shared<const solver::Constraints>(std::move(walls));
  const auto speed = [](glm::dvec3) { return 0.5; };
  const auto flow = [](glm::dvec3) { return glm::vec3(0.1F); };
  solver::Parameters parameters;
  parameters.scheme = scheme;
  auto level_set = solver::make_executor(kind, source, parameters, options);
  if (!level_set) qFatal("%s", level_set.error().message.c_str());
  for (const auto& constraints : {std::shared_ptr<const solver::Constraints>(), constrained}) {
    must((*level_set)->set_constraints(constraints));
    must((*level_set)->set_speed(nullptr));
    must((*level_set)->set_speed(std::make_shared<FormulaSpeed>(speed)));
    must((*level_set)->set_speed(std::make_shared<FormulaSpeed>(speed, flow, 0.2)));
  }
}

}  // namespace

std::vector<gpu::ProgramSource> solver_variants() {
  std::vector<gpu::ProgramSource> programs;
  const Driver gl33({.version = gpu::GlVersion::gl33}, programs);
  const Driver processor({}, programs);
  const Driver gpu({.as_gpu = true}, programs);
  const auto on_all_drivers = [&](const std::shared_ptr<const Volume>& source, solver::Scheme scheme,
                                  std::initializer_list<Index3> shapes) {
    solver::ExecutorOptions options;
    options.device = gl33.device;
    drive(solver::ExecutorKind::stream, source, scheme, options);
    for (const Driver* driver : {&processor, &gpu}) {
      options.device = driver->device;
      for (const Index3 shape : shapes) {
        options.page_shape = shape;
        drive(solver::ExecutorKind::compute, source, scheme, options);
      }
    }
  };
  for (const glm::dvec3 spacing : {glm::dvec3(1.0), glm::dvec3(1.0, 1.0, 2.0)}) {
    const auto source = source_with<std::int16_t>(spacing);
    for (const solver::Scheme scheme : {solver::Scheme::split, solver::Scheme::paper}) {
      on_all_drivers(source, scheme, {Index3(8), Index3(16, 16, 1)});
      solver::Parameters parameters;
      parameters.scheme = scheme;
      const auto start = solver::Field::empty(source->geometry, solver::default_band(source->geometry));
      must(bench::run_dense_gl(*processor.device, *source, parameters, start, 1));
    }
  }
  // The kind of sampler matters to no other choice.
  const auto split = solver::Scheme::split;
  on_all_drivers(source_with<std::uint16_t>(glm::dvec3(1.0)), split, {Index3(8)});
  on_all_drivers(source_with<float>(glm::dvec3(1.0)), split, {Index3(8)});
  // No such source fits in one texture.
  const Driver small_gl33({.version = gpu::GlVersion::gl33, .largest_volume_texture = 8}, programs);
  const Driver small_gl45({.largest_volume_texture = 8}, programs);
  solver::ExecutorOptions options;
  for (const auto& source :
       {source_with<std::int16_t>(glm::dvec3(1.0)), source_with<std::uint16_t>(glm::dvec3(1.0)),
        source_with<float>(glm::dvec3(1.0))}) {
    options.device = small_gl33.device;
    drive(solver::ExecutorKind::stream, source, split, options);
    options.device = small_gl45.device;
    drive(solver::ExecutorKind::compute, source, split, options);
  }
  return programs;
}

}  // namespace tidemark::test
