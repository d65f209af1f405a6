// The executors side by side: no file, no phantom of the library, nothing but the solver and OpenGL, so that
// this program is easily taken to another machine. Everything grows from a seed in SIZE^3 voxels.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "core/stopwatch.h"
#include "core/thread_pool.h"
#include "core/volume.h"
#include "dense_gl.h"
#include "gpu/device.h"
#include "solver/executor.h"
#include "solver/model.h"
#include "solver/statistics.h"
#include "solver/surface_places.h"

namespace tidemark {
namespace {

struct Settings {
  std::vector<std::string> executors = {"host"};
  std::int64_t size = 256;
  int threads = 0;
  std::int64_t steps = 400;
  int page_side = 8;  // 16: pages of 16 x 16 x 1
  bool all_pages = false;
  bool time_paging = false;
  bool spheres = false;
};

// 750 in four balls that have grown into each other, 470 around them, with fine mottle.
Volume blobs(std::int64_t size, ThreadPool& pool) {
  Volume volume;
  volume.geometry.size = Index3(size);
  std::vector<float> values(static_cast<std::size_t>(volume.geometry.voxel_count()));
  const double unit = static_cast<double>(size) / 256.0;
  const glm::dvec4 balls[] = {
      {128, 128, 128, 28}, {140, 146, 140, 18}, {116, 110, 134, 17}, {136, 122, 110, 16}};
  pool.for_each(size, 1, [&](std::int64_t first, std::int64_t last, int) {
    for (std::int64_t k = first; k < last; ++k) {
      for (std::int64_t j = 0; j < size; ++j) {
        for (std::int64_t i = 0; i < size; ++i) {
          const glm::dvec3 p(i, j, k);
          double sum = 0.0;
          for (const glm::dvec4& ball : balls) {
            const double r = glm::length(p - unit * glm::dvec3(ball)) - unit * ball.w;
            sum += std::exp(-std::clamp(r, -50.0, 50.0) / 3.0);
          }
          const double inside = sum / (1.0 + sum);  // 0.5 on the boundary
          const double mottle = std::sin(0.7 * p.x) * std::sin(0.6 * p.y) * std::sin(0.5 * p.z);
          values[static_cast<std::size_t>(volume.geometry.offset({i, j, k}))] =
              static_cast<float>(470.0 + 280.0 * inside + 15.0 * mottle);
        }
      }
    }
  });
  volume.voxels = std::move(values);
  return volume;
}

solver::Parameters parameters() {
  solver::Parameters parameters;
  parameters.target = 750.0;
  parameters.range = 140.0;
  parameters.alpha = 0.5;
  return parameters;
}

void print_run(const std::string& stage, const solver::AdvanceReport& run, const solver::Executor& executor) {
  const solver::MemoryReport memory = executor.memory();
  fmt::print("  {:<16} {:>7} {:>12.0f} {:>13.1f} {:>9.1f} {:>9} {:>9}\n", stage, run.steps,
             static_cast<double>(run.steps) / run.seconds,
             static_cast<double>(run.voxel_updates) / run.seconds / 1e6,
             100.0 * run.paging_seconds / run.seconds, memory.resident_pages, memory.quiet_pages);
}

Result<solver::ExecutorKind> kind_of(const std::string& name) {
  if (const auto kind = solver::executor_named(name)) return *kind;
  return fail(ErrorKind::usage, "the executor '{}' is unknown; use host, compute, stream or dense", name);
}

// Voxels that are not clamped: those that a band no wider than need be would hold.
std::int64_t needed_voxels(const solver::Field& phi) {
  const auto limit = static_cast<float>(phi.band);
  const std::vector<float> values = phi.dense();
  return std::count_if(values.begin(), values.end(), [limit](float v) { return std::abs(v) < limit; });
}

double milliseconds(const Stopwatch& stopwatch) {
  return 1e3 * stopwatch.seconds();
}

// The median of some dabs of 10 mm on the surface, each with a copy of phi and its figures, as a stroke of
// the brush makes them.
Status measure_dabs(solver::Executor& executor, const Geometry& geometry) {
  constexpr int kDabs = 15;
  solver::SurfaceMeter meter;
  std::array<std::vector<double>, 3> times;
  auto phi = executor.snapshot();
  if (!phi) return pass_on(phi);
  meter.measure(*phi);
  const std::vector<glm::dvec3> places = solver::surface_places(*phi, std::nullopt, 20.0);
  for (int dab = 0; dab < kDabs && !places.empty(); ++dab) {
    const glm::dvec3 place = places[static_cast<std::size_t>(dab) * places.size() / kDabs];
    Stopwatch paint;
    TIDEMARK_TRY(executor.paint(solver::sphere_at_voxel(geometry, place, 5.0),
                                dab % 2 == 0 ? solver::Brush::add : solver::Brush::erase));
    times[0].push_back(milliseconds(paint));
    Stopwatch copy;
    phi = executor.snapshot();
    if (!phi) return pass_on(phi);
    times[1].push_back(milliseconds(copy));
    Stopwatch figures;
    meter.measure(*phi);
    times[2].push_back(milliseconds(figures));
  }
  const auto median = [](std::vector<double>& of) {
    if (of.empty()) return 0.0;
    std::nth_element(of.begin(), of.begin() + kDabs / 2, of.end());
    return of[kDabs / 2];
  };
  fmt::print("  a dab of 10 mm: paint {:.2f} ms, copy {:.2f} ms, figures {:.2f} ms\n", median(times[0]),
             median(times[1]), median(times[2]));
  return {};
}

// phi when `settings.steps` steps are done.
Result<solver::Field> measure_executor(const std::shared_ptr<const Volume>& source, const Settings& settings,
                                       const std::string& name) {
  const auto kind = kind_of(name);
  if (!kind) return pass_on(kind);
  solver::ExecutorOptions options;
  options.threads = settings.threads;
  options.skip_quiet_pages = !settings.all_pages;
  options.time_paging = settings.time_paging;
  options.memory_budget_bytes = std::int64_t{64} << 30;
  if (settings.page_side == 16) options.page_shape = {16, 16, 1};
  auto executor = solver::make_executor(*kind, source, parameters(), options);
  if (!executor) return pass_on(executor);
  const double unit = static_cast<double>(settings.size) / 256.0;
  const solver::Sphere seed =
      solver::sphere_at_voxel(source->geometry, glm::dvec3(128.0 * unit), 10.0 * unit);
  TIDEMARK_TRY((*executor)->paint(seed, solver::Brush::add));
  TIDEMARK_TRY((*executor)->advance({}));  // compiles kernels

  fmt::print("{}\n  {:<16} {:>7} {:>12} {:>13} {:>9} {:>9} {:>9}\n", name, "stage", "steps", "steps/s",
             "M updates/s", "paging %", "pages", "quiet");
  const std::int64_t stage = std::max<std::int64_t>(settings.steps / 4, 1);
  for (int i = 1; i <= 4; ++i) {
    auto run = (*executor)->advance({.steps = stage});
    if (!run) return pass_on(run);
    print_run(fmt::format("quarter {}", i), *run, **executor);
  }
  auto phi = (*executor)->snapshot();
  if (!phi) return pass_on(phi);
  const solver::MemoryReport memory = (*executor)->memory();
  const Index3 shape = memory.page_shape;
  const auto resident = static_cast<double>(memory.peak_resident_pages * shape.x * shape.y * shape.z);
  auto rest = (*executor)->advance({.steps = 20 * settings.steps});
  if (!rest) return pass_on(rest);
  auto converged = (*executor)->advance({.steps = settings.steps});
  if (!converged) return pass_on(converged);
  print_run("at rest", *converged, **executor);
  const solver::SurfaceStatistics surface = solver::measure(*phi);
  fmt::print("  processed/needed voxels {:.2f}\n", static_cast<double>(phi->pages.stored()) *
                                                       static_cast<double>(phi->layout.voxels_per_page()) /
                                                       static_cast<double>(needed_voxels(*phi)));
  fmt::print(
      "  {} voxels inside, {:.1f} mm^2 of surface; {:.2f} bytes of state per resident voxel; a step at rest "
      "{:.1f} us\n",
      surface.voxels_inside, surface.surface_mm2, static_cast<double>(memory.peak_state_bytes) / resident,
      1e6 * converged->seconds / static_cast<double>(converged->steps));
  TIDEMARK_TRY(measure_dabs(**executor, source->geometry));
  TIDEMARK_TRY((*executor)->validate());
  return phi;
}

// Spheres of growing radius, every page computed: is the cost a line over the resident voxels?
Status measure_spheres(const std::shared_ptr<const Volume>& source, const Settings& settings,
                       const std::string& name) {
  const auto kind = kind_of(name);
  if (!kind) return pass_on(kind);
  fmt::print("{}, spheres\n  {:>8} {:>16} {:>12} {:>14} {:>18}\n", name, "radius", "resident voxels",
             "us/step", "state bytes", "processed/needed");
  std::vector<glm::dvec3> points;  // resident voxels, seconds a step, bytes
  for (const double part : {0.08, 0.16, 0.24, 0.32, 0.4}) {
    solver::ExecutorOptions options;
    options.threads = settings.threads;
    options.skip_quiet_pages = false;
    options.memory_budget_bytes = std::int64_t{64} << 30;
    if (settings.page_side == 16) options.page_shape = {16, 16, 1};
    auto executor = solver::make_executor(*kind, source, parameters(), options);
    if (!executor) return pass_on(executor);
    const double radius = part * static_cast<double>(settings.size);
    const solver::Sphere ball =
        solver::sphere_at_voxel(source->geometry, 0.5 * glm::dvec3(source->geometry.size), radius);
    TIDEMARK_TRY((*executor)->paint(ball, solver::Brush::add));
    TIDEMARK_TRY((*executor)->advance({.steps = 2}));
    const auto run = (*executor)->advance({.steps = std::max<std::int64_t>(settings.steps / 10, 1)});
    if (!run) return pass_on(run);
    const auto phi = (*executor)->snapshot();
    if (!phi) return pass_on(phi);
    const solver::MemoryReport memory = (*executor)->memory();
    const auto resident = static_cast<double>(memory.resident_pages * memory.page_shape.x *
                                              memory.page_shape.y * memory.page_shape.z);
    points.emplace_back(resident, run->seconds / static_cast<double>(run->steps), memory.state_bytes);
    fmt::print("  {:>8.0f} {:>16.0f} {:>12.0f} {:>14} {:>18.2f}\n", radius, resident, 1e6 * points.back().y,
               memory.state_bytes, resident / static_cast<double>(needed_voxels(*phi)));
  }
  for (const int what : {1, 2}) {
    glm::dvec3 mean(0.0);
    for (const glm::dvec3& p : points) mean += p / static_cast<double>(points.size());
    double xx = 0.0;
    double xy = 0.0;
    double yy = 0.0;
    for (const glm::dvec3& p : points) {
      xx += (p.x - mean.x) * (p.x - mean.x);
      xy += (p.x - mean.x) * (p[what] - mean[what]);
      yy += (p[what] - mean[what]) * (p[what] - mean[what]);
    }
    fmt::print("  {} over resident voxels: R^2 {:.4f}\n", what == 1 ? "time" : "bytes", xy * xy / (xx * yy));
  }
  return {};
}

Status measure_dense(const std::shared_ptr<const Volume>& source, const Settings& settings) {
  const solver::Field start = solver::Field::empty(source->geometry, solver::default_band(source->geometry));
  const std::int64_t steps = std::clamp<std::int64_t>(settings.steps / 20, 3, 100);
  const auto device = gpu::Device::create_headless({});
  if (!device) return pass_on(device);
  const auto run = bench::run_dense_gl(**device, *source, parameters(), start, steps);
  if (!run) return pass_on(run);
  const double steps_per_second = static_cast<double>(run->steps) / run->seconds;
  fmt::print("dense, the whole volume on OpenGL\n  {:>8.1f} steps/s {:>12.1f} M updates/s\n",
             steps_per_second, steps_per_second * static_cast<double>(source->geometry.voxel_count()) / 1e6);
  return {};
}

Status print_device() {
  auto device = gpu::Device::create_headless({});
  if (!device) return pass_on(device);
  for (const auto& [name, value] : (*device)->capabilities().entries())
    fmt::print("  {:<24} {}\n", name, value);
  return {};
}

Status run(const Settings& settings) {
  ThreadPool pool(settings.threads);
  const auto source = std::make_shared<const Volume>(blobs(settings.size, pool));
  fmt::print("{}^3 voxels, {} threads\n", settings.size, pool.threads());
  if (settings.executors != std::vector<std::string>{"host"}) {
    TIDEMARK_TRY(print_device());
  }
  std::optional<Mask> first;
  for (const std::string& name : settings.executors) {
    if (settings.spheres) {
      TIDEMARK_TRY(measure_spheres(source, settings, name));
      continue;
    }
    if (name == "dense") {
      TIDEMARK_TRY(measure_dense(source, settings));
      continue;
    }
    auto phi = measure_executor(source, settings, name);
    if (!phi) return pass_on(phi);
    const Mask mask = phi->mask();
    if (first) fmt::print("  Dice with the first executor {:.5f}\n", dice(*first, mask));
    if (!first) first = mask;
  }
  return {};
}

}  // namespace
}  // namespace tidemark

int main(int argc, char** argv) {
  tidemark::Settings settings;
  CLI::App app("The executors side by side on a volume made in memory", "solver_bench");
  app.add_option("--executor", settings.executors, "host, compute, stream or dense; several are compared");
  app.add_option("--size", settings.size, "Voxels along each axis (256)")->check(CLI::Range(32, 1024));
  app.add_option("--threads", settings.threads, "Of host (0: all processors)")->check(CLI::Range(0, 1024));
  app.add_option("--steps", settings.steps, "From the seed on (400)")->check(CLI::Range(4, 1000000));
  app.add_option("--page-side", settings.page_side, "8: 8 x 8 x 8; 16: 16 x 16 x 1")
      ->check(CLI::IsMember({8, 16}));
  app.add_flag("--all-pages", settings.all_pages, "Compute quiet pages, too");
  app.add_flag("--time-paging", settings.time_paging,
               "Wait between dispatches to find out what paging takes");
  app.add_flag("--spheres", settings.spheres, "Cost of spheres of growing radius instead");
  CLI11_PARSE(app, argc, argv);
  const auto status = tidemark::run(settings);
  if (status) return 0;
  fmt::print(stderr, "solver_bench: {}\n", status.error().message);
  return tidemark::exit_code(status.error().kind);
}
