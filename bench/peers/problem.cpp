#include "bench/peers/problem.h"

#include <algorithm>
#include <cmath>

#include "imaging/filters/filters.h"
#include "solver/distance_transform.h"

namespace tidemark::bench {
namespace {

std::vector<float> sphere_distance(const Geometry& geometry, const solver::Sphere& sphere, double band) {
  std::vector<float> distance(static_cast<std::size_t>(geometry.voxel_count()), static_cast<float>(-band));
  const glm::dvec3 centre = geometry.to_voxel(sphere.centre_mm);
  const double radius = sphere.radius_mm / geometry.spacing_mm.x;
  const auto reach = static_cast<std::int64_t>(std::ceil(radius + band));
  const Index3 middle(glm::round(centre));
  const Index3 low = glm::max(middle - reach, Index3(0));
  const Index3 high = glm::min(middle + reach, geometry.size - std::int64_t{1});
  for (std::int64_t k = low.z; k <= high.z; ++k) {
    for (std::int64_t j = low.y; j <= high.y; ++j) {
      for (std::int64_t i = low.x; i <= high.x; ++i) {
        const double d = radius - glm::length(glm::dvec3(i, j, k) - centre);
        distance[static_cast<std::size_t>(geometry.offset({i, j, k}))] =
            static_cast<float>(std::clamp(d, -band, band));
      }
    }
  }
  return distance;
}

}  // namespace

Result<Problem> make_problem(std::string_view phantom_kind, const imaging::PhantomOptions& options) {
  auto phantom = imaging::make_phantom(phantom_kind, options);
  if (!phantom) return pass_on(phantom);
  Problem problem;
  problem.name = phantom_kind;
  problem.values = phantom->volume.values();
  problem.parameters.target = phantom->target;
  problem.parameters.range = phantom->range;
  problem.parameters.alpha = phantom->alpha;
  const Geometry& geometry = phantom->volume.geometry;
  // A threshold comes first: it starts with the whole surface, which a seed takes a thousand steps to reach.
  if (phantom->init_threshold) {
    problem.start =
        imaging::threshold(phantom->volume, phantom->init_threshold->first, phantom->init_threshold->second);
  } else if (phantom->seed) {
    const auto& [i, j, k, radius_mm] = *phantom->seed;
    problem.seed = solver::sphere_at_voxel(geometry, {i, j, k}, radius_mm);
  } else {
    return fail(ErrorKind::internal, "the phantom {} has no start", phantom_kind);
  }
  problem.truth = std::move(phantom->truth);
  problem.source = std::make_shared<const Volume>(std::move(phantom->volume));
  return problem;
}

std::vector<float> start_distance(const Problem& problem, double band) {
  if (problem.seed) return sphere_distance(problem.source->geometry, *problem.seed, band);
  return solver::distance_transform(*problem.start, band).dense();
}

}  // namespace tidemark::bench
