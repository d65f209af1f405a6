#include "document/start.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "imaging/filters/filters.h"
#include "solver/distance_transform.h"
#include "solver/speed/growing_region.h"
#include "solver/speed/motion_limit.h"

namespace tidemark::document {
namespace {

constexpr double kGridTolerance = 0.1;  // of the smallest spacing: files round their numbers

using Parts = std::vector<std::string>;

struct Describe {
  Parts operator()(std::monostate) const { return {}; }
  Parts operator()(const ThresholdStart& start) const {
    return {fmt::format("values {} to {}", start.low, start.high)};
  }
  Parts operator()(const FloodStart& start) const {
    return {fmt::format("flood fill, values {} to {}", start.low, start.high)};
  }
  Parts operator()(const SpeedStart&) const { return {"where the speed is above 0"}; }
  Parts operator()(const MaskStart& start) const {
    Parts parts{start.origin.empty() ? "mask" : fmt::format("mask {}", start.origin)};
    if (start.limit != nullptr) parts.push_back(fmt::format("within {} mm", start.limit->within_mm()));
    return parts;
  }
  Parts operator()(const FieldStart& start) const {
    return {start.origin.empty() ? "phi" : fmt::format("phi {}", start.origin)};
  }
};

Status check_grid(const Geometry& part, const Geometry& grid, const char* what) {
  const double tolerance =
      kGridTolerance * std::min({grid.spacing_mm.x, grid.spacing_mm.y, grid.spacing_mm.z});
  if (part.size == grid.size && same_grid(part, grid, tolerance)) return {};
  return fail(ErrorKind::usage,
              "the start's {} has a grid of {} x {} x {} voxels that is not the volume's of {} x {} x {}",
              what, part.size.x, part.size.y, part.size.z, grid.size.x, grid.size.y, grid.size.z);
}

Status check_sphere(const solver::Sphere& sphere, const Geometry& grid, const char* what) {
  if (sphere.radius_mm > 0.0 && grid.covers(sphere.centre_mm)) return {};
  const glm::dvec3 voxel = grid.to_voxel(sphere.centre_mm);
  return fail(ErrorKind::usage,
              "{} at voxel ({:.6g}, {:.6g}, {:.6g}) with a radius of {} mm is not in the "
              "volume of {} x {} x {} voxels",
              what, voxel.x, voxel.y, voxel.z, sphere.radius_mm, grid.size.x, grid.size.y, grid.size.z);
}

// What is inside by the first part.
struct FirstInside {
  const StartInputs& inputs;
  const Progress& progress;
  const Volume& source = inputs.source;

  using Found = Result<std::optional<Inside>>;

  Found operator()(std::monostate) const { return std::nullopt; }
  Found operator()(const ThresholdStart& start) const {
    return imaging::between(source, start.low, start.high);
  }
  Found operator()(const FloodStart& start) const {
    auto region = imaging::flood_fill(source, start.voxel, start.low, start.high);
    if (!region) return pass_on(region);
    return tidemark::inside_of(std::make_shared<const BitMask>(std::move(*region)));
  }
  Found operator()(const SpeedStart&) const {
    if (inputs.speed->follows_surface()) {
      return fail(ErrorKind::usage,
                  "the speed follows the surface: where it is above 0 is known once there is a surface");
    }
    auto region = solver::growing_region(*inputs.speed, source.geometry, progress);
    if (!region) return pass_on(region);
    return tidemark::inside_of(std::make_shared<const BitMask>(std::move(*region)));
  }
  Found operator()(const MaskStart& start) const {
    TIDEMARK_TRY(check_grid(start.mask->geometry(), source.geometry, "mask"));
    return tidemark::inside_of(start.mask);
  }
  Found operator()(const FieldStart&) const { return std::nullopt; }
};

// The first part as phi.
Result<solver::Field> first_part(const solver::Executor& executor, const StartInputs& inputs,
                                 const Start& start, const Progress& progress) {
  const Geometry& grid = inputs.source.geometry;
  if (const auto* saved = std::get_if<FieldStart>(&start.from)) {
    TIDEMARK_TRY(check_grid(saved->phi->geometry, grid, "phi"));
    if (saved->phi->check_fits(grid, executor.band())) return *saved->phi;
    return saved->phi->repaged(executor.band(), executor.memory().page_shape);
  }
  const auto inside = inside_of(start, inputs, progress);
  if (!inside) return pass_on(inside);
  if (!*inside) return solver::Field::empty(grid, executor.band());
  return solver::distance_transform(**inside, executor.band(), executor.memory().page_shape);
}

}  // namespace

Result<solver::Field> place(solver::Executor& executor, const StartInputs& inputs, const Start& start,
                            const Progress& progress) {
  {
    auto first = first_part(executor, inputs, start, progress);
    if (!first) return first;
    if (progress.cancelled()) return cancelled_error();
    TIDEMARK_TRY(executor.restore(*first));
  }
  for (const solver::Sphere& sphere : start.seeds) {
    TIDEMARK_TRY(executor.paint(sphere, solver::Brush::add));
  }
  for (const solver::Sphere& sphere : start.erasers) {
    TIDEMARK_TRY(executor.paint(sphere, solver::Brush::erase));
  }
  if (progress.cancelled()) return cancelled_error();
  return executor.snapshot();
}

Status check_spheres(const Start& start, const Geometry& grid) {
  for (const solver::Sphere& sphere : start.seeds) {
    TIDEMARK_TRY(check_sphere(sphere, grid, "a seed"));
  }
  for (const solver::Sphere& sphere : start.erasers) {
    TIDEMARK_TRY(check_sphere(sphere, grid, "an eraser"));
  }
  return {};
}

Result<std::optional<Inside>> inside_of(const Start& start, const StartInputs& inputs,
                                        const Progress& progress) {
  return std::visit(FirstInside{inputs, progress}, start.from);
}

std::vector<std::string> Start::parts() const {
  Parts parts = std::visit(Describe{}, from);
  if (!seeds.empty()) parts.push_back(seeds.size() == 1 ? "1 seed" : fmt::format("{} seeds", seeds.size()));
  if (!erasers.empty())
    parts.push_back(erasers.size() == 1 ? "1 eraser" : fmt::format("{} erasers", erasers.size()));
  if (parts.empty()) return {"nothing"};
  if (levels > 1) parts.push_back(fmt::format("coarse to fine in {} levels", levels));
  return parts;
}

std::string Start::describe() const {
  return fmt::format("{}", fmt::join(parts(), ", "));
}

Start suggested_start(const Geometry& geometry, const std::optional<std::array<double, 4>>& seed,
                      const std::optional<std::pair<double, double>>& threshold) {
  Start start;
  if (seed) {
    const auto& [i, j, k, radius_mm] = *seed;
    start.seeds.push_back({geometry.to_patient({i, j, k}), radius_mm});
  } else if (threshold) {
    start.from = ThresholdStart{threshold->first, threshold->second};
  }
  return start;
}

Result<solver::Field> begin(solver::Executor& executor, const StartInputs& inputs, const Start& start,
                            const Progress& progress) {
  TIDEMARK_TRY(check_spheres(start, inputs.source.geometry));
  const auto before = executor.snapshot();
  if (!before) return pass_on(before);
  auto phi = place(executor, inputs, start, progress);
  if (phi && !phi->has_inside()) {
    phi = fail(ErrorKind::usage, "the start is empty: no voxel is inside ({})", start.describe());
  }
  if (!phi) {
    TIDEMARK_TRY(executor.restore(*before));
  }
  return phi;
}

}  // namespace tidemark::document
