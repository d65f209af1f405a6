#include "solver/surface_agreement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <utility>
#include <vector>

#include "solver/point_tree.h"

namespace tidemark::solver {
namespace {

// Calls visit(voxel) for the voxels of all pages but those that are outside throughout. Returns false when it
// was stopped.
template <class Visit>
bool for_each_voxel(const Field& phi, const Progress& progress, const Visit& visit) {
  for (std::int64_t page = 0; page < phi.layout.page_count(); ++page) {
    if (phi.table[static_cast<std::size_t>(page)] == Field::kOutside) continue;
    if (progress.cancelled()) return false;
    const Index3 first = phi.layout.first_voxel(page);
    const Index3 valid = phi.layout.valid_shape(page);
    for (Index3 local(0); local.z < valid.z; ++local.z) {
      for (local.y = 0; local.y < valid.y; ++local.y) {
        for (local.x = 0; local.x < valid.x; ++local.x) visit(first + local);
      }
    }
  }
  return true;
}

struct Overlap {
  std::int64_t inside = 0;  // of the one
  std::int64_t common = 0;  // of both
};

Result<Overlap> overlap(const Field& one, const Field& other, const Progress& progress) {
  Overlap result;
  const bool whole = for_each_voxel(one, progress, [&](Index3 voxel) {
    if (one.at(voxel) <= 0.0F) return;
    ++result.inside;
    result.common += other.at(voxel) > 0.0F ? 1 : 0;
  });
  if (!whole) return cancelled_error();
  return result;
}

// Where grid lines between voxel centres cross phi = 0, in mm along the grid's axes from its first voxel. A
// crossing has a voxel inside at one of its ends.
Result<std::vector<glm::vec3>> crossings(const Field& phi, const Progress& progress) {
  const Geometry& geometry = phi.geometry;
  const glm::vec3 spacing(geometry.spacing_mm);
  std::vector<glm::vec3> points;
  const bool whole = for_each_voxel(phi, progress, [&](Index3 voxel) {
    const float value = phi.at(voxel);
    if (value <= 0.0F) return;
    for (int side = 0; side < 6; ++side) {
      Index3 step(0);
      step[side / 2] = side % 2 == 0 ? 1 : -1;
      if (!geometry.contains(voxel + step)) continue;
      const float next = phi.at(voxel + step);
      if (next > 0.0F) continue;
      points.push_back((glm::vec3(voxel) + glm::vec3(step) * (value / (value - next))) * spacing);
    }
  });
  if (!whole) return cancelled_error();
  return points;
}

struct Distances {
  double sum_mm = 0.0;
  double largest_mm = 0.0;
};

// From every point of the one to the other.
Result<Distances> distances(const PointTree& from, const PointTree& to, const Progress& progress) {
  constexpr std::size_t kStride = 4096;  // points between two looks at the request to stop
  Distances result;
  std::size_t hint = 0;
  for (std::size_t i = 0; i < from.points().size(); ++i) {
    if (i % kStride == 0 && progress.cancelled()) return cancelled_error();
    const auto distance = static_cast<double>(to.distance(from.points()[i], hint));
    result.sum_mm += distance;
    result.largest_mm = std::max(result.largest_mm, distance);
  }
  return result;
}

Result<std::optional<SurfaceDistance>> distance_between(const Field& a, const Field& b,
                                                        const Progress& progress) {
  auto points_a = crossings(a, progress);
  if (!points_a) return pass_on(points_a);
  auto points_b = crossings(b, progress);
  if (!points_b) return pass_on(points_b);
  if (points_a->empty() || points_b->empty()) return std::optional<SurfaceDistance>();
  const PointTree tree_a(std::move(*points_a));
  const PointTree tree_b(std::move(*points_b));
  auto there = distances(tree_a, tree_b, progress);
  if (!there) return pass_on(there);
  auto back = distances(tree_b, tree_a, progress);
  if (!back) return pass_on(back);
  const auto count = static_cast<double>(tree_a.points().size() + tree_b.points().size());
  return std::optional<SurfaceDistance>(
      {(there->sum_mm + back->sum_mm) / count, std::max(there->largest_mm, back->largest_mm)});
}

}  // namespace

Result<SurfaceAgreement> agreement(const Field& a, const Field& b, const Progress& progress) {
  if (a.geometry.size != b.geometry.size) return fail(ErrorKind::usage, "the level sets have other grids");
  auto of_a = overlap(a, b, progress);
  if (!of_a) return pass_on(of_a);
  auto of_b = overlap(b, a, progress);
  if (!of_b) return pass_on(of_b);
  SurfaceAgreement result;
  if (const std::int64_t both = of_a->inside + of_b->inside; both > 0)
    result.dice = 2.0 * static_cast<double>(of_a->common) / static_cast<double>(both);
  auto distance = distance_between(a, b, progress);
  if (!distance) return pass_on(distance);
  result.distance = *distance;
  return result;
}

}  // namespace tidemark::solver
