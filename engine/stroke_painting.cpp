#include "engine/stroke_painting.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <iterator>

namespace tidemark::engine {
namespace {

// Calls `visit` with the places in `voxels` of the up to 26 neighbours of a voxel that are among them.
template <class Visit>
void visit_neighbours(const Geometry& geometry, const std::vector<std::int64_t>& voxels, std::int64_t offset,
                      Visit&& visit) {
  const Index3 voxel = geometry.voxel_at(offset);
  for (int neighbour = 0; neighbour < 27; ++neighbour) {
    const Index3 other = voxel + Index3(neighbour % 3 - 1, neighbour / 3 % 3 - 1, neighbour / 9 - 1);
    if (other == voxel || !geometry.contains(other)) continue;
    const auto found = std::ranges::lower_bound(voxels, geometry.offset(other));
    if (found != voxels.end() && *found == geometry.offset(other))
      visit(static_cast<std::size_t>(found - voxels.begin()));
  }
}

// Calls `visit` with the places in `voxels` of each connected stroke.
template <class Visit>
void visit_strokes(const Geometry& geometry, const std::vector<std::int64_t>& voxels, Visit&& visit) {
  std::vector<bool> seen(voxels.size());
  std::vector<std::size_t> stroke;
  for (std::size_t first = 0; first < voxels.size(); ++first) {
    if (seen[first]) continue;
    seen[first] = true;
    stroke = {first};
    for (std::size_t now = 0; now < stroke.size(); ++now) {
      visit_neighbours(geometry, voxels, voxels[stroke[now]], [&](std::size_t next) {
        if (seen[next]) return;
        seen[next] = true;
        stroke.push_back(next);
      });
    }
    visit(stroke);
  }
}

std::vector<std::int64_t> without(const std::vector<std::int64_t>& a, const std::vector<std::int64_t>& b) {
  std::vector<std::int64_t> rest;
  std::ranges::set_difference(a, b, std::back_inserter(rest));
  return rest;
}

std::vector<std::int64_t> with(const std::vector<std::int64_t>& a, const std::vector<std::int64_t>& b) {
  std::vector<std::int64_t> all;
  std::ranges::set_union(a, b, std::back_inserter(all));
  return all;
}

}  // namespace

std::shared_ptr<const solver::Strokes> painted(const solver::Strokes* strokes,
                                               const std::vector<std::int64_t>& voxels, Mark mark) {
  static const solver::Strokes kNone;
  const solver::Strokes& before = strokes ? *strokes : kNone;
  auto after = std::make_shared<solver::Strokes>();
  after->inside = mark == Mark::inside ? with(before.inside, voxels) : without(before.inside, voxels);
  after->outside = mark == Mark::outside ? with(before.outside, voxels) : without(before.outside, voxels);
  if (after->empty()) return nullptr;
  return after;
}

bool can_teach(const solver::Strokes* strokes) {
  return strokes && !strokes->inside.empty() && !strokes->outside.empty();
}

std::int64_t count_strokes(const Geometry& geometry, const std::vector<std::int64_t>& voxels) {
  std::int64_t strokes = 0;
  visit_strokes(geometry, voxels, [&](const std::vector<std::size_t>&) { ++strokes; });
  return strokes;
}

std::vector<Index3> middles_of_strokes(const Geometry& geometry, const std::vector<std::int64_t>& voxels) {
  std::vector<Index3> middles;
  visit_strokes(geometry, voxels, [&](const std::vector<std::size_t>& stroke) {
    const auto voxel = [&](std::size_t place) { return geometry.voxel_at(voxels[place]); };
    glm::dvec3 mean(0.0);
    for (const std::size_t place : stroke) mean += glm::dvec3(voxel(place));
    mean /= static_cast<double>(stroke.size());
    middles.push_back(voxel(*std::ranges::min_element(
        stroke, {}, [&](std::size_t place) { return glm::distance(glm::dvec3(voxel(place)), mean); })));
  });
  return middles;
}

std::vector<solver::Sphere> spheres_along(const Geometry& geometry, const std::vector<std::int64_t>& voxels) {
  // Those in the middle of a stroke come first: they have the most neighbours.
  std::vector<std::pair<int, std::int64_t>> by_neighbours;
  by_neighbours.reserve(voxels.size());
  for (const std::int64_t offset : voxels) {
    int neighbours = 0;
    visit_neighbours(geometry, voxels, offset, [&](std::size_t) { ++neighbours; });
    by_neighbours.emplace_back(-neighbours, offset);
  }
  std::ranges::sort(by_neighbours);
  const glm::dvec3 spacing = geometry.spacing_mm;
  const double radius_mm = 2.0 * std::min({spacing.x, spacing.y, spacing.z});
  constexpr std::size_t kMost = 500;  // far more than strokes need, and soon placed
  std::vector<solver::Sphere> spheres;
  for (const auto& [neighbours, offset] : by_neighbours) {
    const glm::dvec3 centre_mm = geometry.to_patient(glm::dvec3(geometry.voxel_at(offset)));
    const bool is_near = std::ranges::any_of(spheres, [&](const solver::Sphere& sphere) {
      return glm::distance(sphere.centre_mm, centre_mm) < 1.5 * radius_mm;
    });
    if (!is_near) spheres.push_back({centre_mm, radius_mm});
    if (spheres.size() == kMost) break;
  }
  return spheres;
}

document::Start start_in(const Geometry& geometry, const solver::Strokes& strokes) {
  document::Start start;
  start.seeds = spheres_along(geometry, strokes.inside);
  return start;
}

}  // namespace tidemark::engine
