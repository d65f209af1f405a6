// The host executor alone: no file, no phantom, no library but the solver's own, so that this program is
// easily taken to another machine.
//
//   solver_bench [SIZE [THREADS [STEPS]]]     a tumour in SIZE^3 voxels (256), all processors, 400 steps
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <vector>

#include "core/thread_pool.h"
#include "core/volume.h"
#include "solver/executor.h"
#include "solver/statistics.h"

namespace tidemark {
namespace {

struct Settings {
  std::int64_t size = 256;
  int threads = 0;
  std::int64_t steps = 400;
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

Status measure_run(const std::shared_ptr<const Volume>& source, const Settings& settings, bool skip_quiet) {
  Parameters parameters;
  parameters.target = 750.0;
  parameters.range = 140.0;
  parameters.alpha = 0.5;
  ExecutorOptions options;
  options.threads = settings.threads;
  options.skip_quiet_pages = skip_quiet;
  auto executor = make_executor(ExecutorKind::host, source, parameters, options);
  if (!executor) return tl::unexpected<Error>(executor.error());
  const double unit = static_cast<double>(settings.size) / 256.0;
  const Sphere seed = sphere_at_voxel(source->geometry, glm::dvec3(128.0 * unit), 10.0 * unit);
  if (auto status = (*executor)->paint(seed, Brush::add); !status) return status;

  fmt::print("{}\n  {:>10} {:>12} {:>14} {:>10} {:>12}\n",
             skip_quiet ? "as users get it" : "no page is quiet", "steps", "steps/s", "M updates/s",
             "paging %", "pages");
  const std::int64_t stage = std::max<std::int64_t>(settings.steps / 4, 1);
  for (int i = 1; i <= 4; ++i) {
    auto run = (*executor)->advance({.steps = stage});
    if (!run) return tl::unexpected<Error>(run.error());
    fmt::print("  {:>10} {:>12.0f} {:>14.1f} {:>10.1f} {:>12}\n", i * stage,
               static_cast<double>(run->steps) / run->seconds,
               static_cast<double>(run->voxel_updates) / run->seconds / 1e6,
               100.0 * run->paging_seconds / run->seconds, (*executor)->memory().resident_pages);
  }
  auto phi = (*executor)->snapshot();
  if (!phi) return pass_on(phi);
  const SurfaceStatistics surface = measure(*phi);
  fmt::print("  {} voxels inside, {:.1f} mm^2 of surface\n", surface.voxels_inside, surface.surface_mm2);
  return (*executor)->validate();
}

int run(const Settings& settings) {
  ThreadPool pool(settings.threads);
  const auto source = std::make_shared<const Volume>(blobs(settings.size, pool));
  fmt::print("{}^3 voxels, {} threads\n", settings.size, pool.threads());
  for (const bool skip_quiet : {true, false}) {
    if (auto status = measure_run(source, settings, skip_quiet); !status) {
      fmt::print(stderr, "solver_bench: {}\n", status.error().message);
      return exit_code(status.error().kind);
    }
  }
  return 0;
}

// A number in [low, high], or -1.
std::int64_t parse(const char* text, std::int64_t low, std::int64_t high) {
  char* end = nullptr;
  const long long value = std::strtoll(text, &end, 10);
  return *end == '\0' && value >= low && value <= high ? value : -1;
}

}  // namespace
}  // namespace tidemark

int main(int argc, char** argv) {
  tidemark::Settings settings;
  if (argc > 1) settings.size = tidemark::parse(argv[1], 32, 1024);
  if (argc > 2) settings.threads = static_cast<int>(tidemark::parse(argv[2], 0, 1024));
  if (argc > 3) settings.steps = tidemark::parse(argv[3], 4, 1000000);
  if (argc > 4 || settings.size < 0 || settings.threads < 0 || settings.steps < 0) {
    fmt::print(stderr, "usage: solver_bench [SIZE [THREADS [STEPS]]]  (32 to 1024, 0 for all, 4 and more)\n");
    return 2;
  }
  return tidemark::run(settings);
}
