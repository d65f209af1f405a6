#include "rates.h"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <ctime>
#include <vector>

#include "core/stopwatch.h"
#include "core/thread_pool.h"
#include "solver/speed/cached_speed.h"
#include "solver/speed/speed_registry.h"
#include "strokes_on.h"

namespace tidemark {
namespace {

struct Measured {
  const char* name;
  solver::SpeedTerm term;
};

// A ball of a third of the grid, as phi.
solver::Field ball_on(const Geometry& geometry) {
  const glm::dvec3 centre = 0.5 * glm::dvec3(geometry.size);
  const double radius =
      static_cast<double>(std::min({geometry.size.x, geometry.size.y, geometry.size.z})) / 3.0;
  std::vector<float> phi;
  phi.reserve(static_cast<std::size_t>(geometry.voxel_count()));
  for (std::int64_t z = 0; z < geometry.size.z; ++z) {
    for (std::int64_t y = 0; y < geometry.size.y; ++y) {
      for (std::int64_t x = 0; x < geometry.size.x; ++x) {
        const glm::dvec3 d = glm::dvec3(x, y, z) - centre;
        phi.push_back(static_cast<float>(radius - std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z)));
      }
    }
  }
  return solver::Field::from_dense(geometry, phi, 2.5);
}

std::vector<solver::VoxelBox> pages_of(const solver::Field& phi) {
  std::vector<solver::VoxelBox> boxes;
  for (std::int64_t page = 0; page < phi.layout.page_count(); ++page) {
    if (!phi.pages.is_stored(page)) continue;
    boxes.push_back({phi.layout.first_voxel(page), phi.layout.valid_shape(page)});
  }
  return boxes;
}

std::vector<solver::VoxelBox> slices_of(Index3 size) {
  return {{{0, 0, size.z / 2}, {size.x, size.y, 1}},
          {{0, size.y / 2, 0}, {size.x, 1, size.z}},
          {{size.x / 2, 0, 0}, {1, size.y, size.z}}};
}

// What this thread has had of a processor: others may want it, too.
double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// Million voxels a second of a processor.
template <class Evaluate>
double rate(const std::vector<solver::VoxelBox>& boxes, const Evaluate& evaluate) {
  std::int64_t voxels = 0;
  const double begin = processor_seconds();
  for (const solver::VoxelBox& box : boxes) {
    evaluate(box);
    voxels += box.voxels();
  }
  return 1e-6 * static_cast<double>(voxels) / (processor_seconds() - begin);
}

// The same by one thread a processor.
double rate_of_all(const solver::SpeedFunction& speed, const std::vector<solver::VoxelBox>& boxes) {
  std::atomic<std::int64_t> voxels = 0;
  ThreadPool threads;
  const Stopwatch watch;
  threads.for_each(std::ssize(boxes), 4, [&](std::int64_t begin, std::int64_t end, int) {
    std::vector<std::int16_t> values(512);
    for (std::int64_t i = begin; i < end; ++i) {
      const solver::VoxelBox& box = boxes[static_cast<std::size_t>(i)];
      solver::evaluate_quantised(speed, box, values.data());
      voxels += box.voxels();
    }
  });
  return 1e-6 * static_cast<double>(voxels) / watch.seconds();
}

Status measure(const solver::SpeedInputs& inputs, const solver::Field& phi, const Measured& measured) {
  const Stopwatch making;
  const solver::SpeedSetting setting{{measured.term}, solver::Combine::least};
  auto made = solver::make_speed(setting, inputs);
  if (!made) return pass_on(made);
  const double seconds_to_make = making.seconds();
  std::shared_ptr<const solver::SpeedFunction> speed = *made;
  const Stopwatch following;
  if (auto next = speed->following(phi)) speed = std::move(next);
  const double seconds_to_follow = following.seconds();

  const auto pages = pages_of(phi);
  std::vector<std::int16_t> values(static_cast<std::size_t>(phi.geometry.voxel_count()));
  std::vector<glm::vec3> flow(512);
  const auto quantised = [&](const solver::VoxelBox& box) {
    solver::evaluate_quantised(*speed, box, values.data());
  };
  const double slices = rate(slices_of(phi.geometry.size), quantised);
  const double first = rate(pages, quantised);
  const double again = rate(pages, quantised);
  const double advection = !speed->advects() ? 0.0 : rate(pages, [&](const solver::VoxelBox& box) {
    speed->evaluate_advection(box, flow.data());
  });
  auto anew = solver::make_speed(setting, inputs);
  if (!anew) return pass_on(anew);
  fmt::print("{:24} {:8.1f} {:8.1f} {:8.1f} {:10.1f} {:10.1f} {:10.1f} {:10.1f}\n", measured.name, first,
             again, slices, rate_of_all(**anew, pages), advection, 1e3 * seconds_to_make,
             1e3 * seconds_to_follow);
  return {};
}

}  // namespace

Status measure_rates(const engine::LoadedStudy& study) {
  solver::SpeedInputs inputs;
  inputs.source = study.volume;
  inputs.strokes = strokes_on(study);
  const Geometry& geometry = inputs.source->geometry;
  const solver::Field phi = ball_on(geometry);
  fmt::print("{} x {} x {}, {} pages at the surface, {} processors\n", geometry.size.x, geometry.size.y,
             geometry.size.z, phi.pages.stored(), available_processors());
  fmt::print("{:24} {:>8} {:>8} {:>8} {:>10} {:>10} {:>10} {:>10}\n", "million voxels / s", "pages", "again",
             "slices", "processors", "velocity", "make ms", "follow ms");
  const double smallest = std::min({geometry.spacing_mm.x, geometry.spacing_mm.y, geometry.spacing_mm.z});
  const Measured all[] = {{"examples", {"examples", {}}},
                          {"regions", {"regions", {}}},
                          {"regions, 5 voxels", {"regions", {{"radius", 5.0 * smallest}}}},
                          {"regions, 10 voxels", {"regions", {{"radius", 10.0 * smallest}}}},
                          {"edges, 1 voxel", {"edges", {{"sigma", smallest}}}},
                          {"edges, 2 voxels", {"edges", {{"sigma", 2.0 * smallest}}}}};
  for (const Measured& one : all) TIDEMARK_TRY(measure(inputs, phi, one));
  return {};
}

}  // namespace tidemark
