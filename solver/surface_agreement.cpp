#include "solver/surface_agreement.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "solver/surface_crossings.h"

namespace tidemark::solver {
namespace {

constexpr double kMost = 0.95;  // of all distances

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

// Adds the distances from every point of the one to the other.
Status add_distances(const PointTree& from, const PointTree& to, const Progress& progress,
                     std::vector<float>& distances) {
  constexpr std::size_t kStride = 4096;  // points between two looks at the request to stop
  std::size_t hint = 0;
  for (std::size_t i = 0; i < from.points().size(); ++i) {
    if (i % kStride == 0 && progress.cancelled()) return cancelled_error();
    distances.push_back(to.distance(from.points()[i], hint));
  }
  return {};
}

// Of distances, of which there are some; changes their order. The percentile is the smallest distance that so
// many are not larger than.
SurfaceDistance summary_of(std::vector<float>& distances) {
  SurfaceDistance summary;
  for (const float distance : distances) summary.mean_mm += static_cast<double>(distance);
  summary.mean_mm /= static_cast<double>(distances.size());
  summary.largest_mm = static_cast<double>(*std::max_element(distances.begin(), distances.end()));
  const auto rank = static_cast<std::ptrdiff_t>(std::ceil(kMost * static_cast<double>(distances.size()))) - 1;
  const auto most = distances.begin() + std::max<std::ptrdiff_t>(rank, 0);
  std::nth_element(distances.begin(), most, distances.end());
  summary.most_mm = static_cast<double>(*most);
  return summary;
}

}  // namespace

Result<MeasuredSurface> MeasuredSurface::of(const Field& phi, const Progress& progress) {
  auto points = surface_crossings(phi, progress);
  if (!points) return pass_on(points);
  return MeasuredSurface(PointTree(std::move(*points)));
}

MeasuredSurface MeasuredSurface::of(const Region& region, const Geometry& grid) {
  std::vector<glm::vec3> points;
  const auto add_face = [&](Index3 voxel, int axis, double side) {
    glm::dvec3 middle(voxel);
    middle[axis] += 0.5 * side;
    points.emplace_back(middle * grid.spacing_mm);
  };
  region.for_each_run([&](Index3 voxel, std::int64_t length) {
    // A run ends where the region does, or the grid.
    if (voxel.x > 0) add_face(voxel, 0, -1.0);
    if (voxel.x + length < grid.size.x) add_face(voxel + Index3(length - 1, 0, 0), 0, 1.0);
    for (const int axis : {1, 2}) {
      for (const std::int64_t side : {-1, 1}) {
        Index3 beside = voxel;
        beside[axis] += side;
        if (beside[axis] < 0 || beside[axis] >= grid.size[axis]) continue;
        for (std::int64_t i = 0; i < length; ++i) {
          if (!region.contains(beside + Index3(i, 0, 0)))
            add_face(voxel + Index3(i, 0, 0), axis, static_cast<double>(side));
        }
      }
    }
  });
  return MeasuredSurface(PointTree(std::move(points)));
}

Result<std::optional<SurfaceDistance>> MeasuredSurface::distance_to(const MeasuredSurface& other,
                                                                    const Progress& progress) const {
  if (empty() || other.empty()) return std::optional<SurfaceDistance>();
  std::vector<float> distances;
  distances.reserve(crossings_.points().size() + other.crossings_.points().size());
  TIDEMARK_TRY(add_distances(crossings_, other.crossings_, progress, distances));
  TIDEMARK_TRY(add_distances(other.crossings_, crossings_, progress, distances));
  return std::optional(summary_of(distances));
}

Result<SurfaceAgreement> agreement(const Field& a, const Field& b, const Progress& progress) {
  if (a.geometry.size != b.geometry.size) return fail(ErrorKind::usage, "the level sets have other grids");
  auto of_a = overlap(a, b, progress);
  if (!of_a) return pass_on(of_a);
  auto of_b = overlap(b, a, progress);
  if (!of_b) return pass_on(of_b);
  SurfaceAgreement result;
  if (const std::int64_t both = of_a->inside + of_b->inside; both > 0)
    result.dice = 2.0 * static_cast<double>(of_a->common) / static_cast<double>(both);
  auto surface_a = MeasuredSurface::of(a, progress);
  if (!surface_a) return pass_on(surface_a);
  auto surface_b = MeasuredSurface::of(b, progress);
  if (!surface_b) return pass_on(surface_b);
  auto distance = surface_a->distance_to(*surface_b, progress);
  if (!distance) return pass_on(distance);
  result.distance = *distance;
  return result;
}

}  // namespace tidemark::solver
