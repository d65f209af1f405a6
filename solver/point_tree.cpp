#include "solver/point_tree.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace tidemark::solver {
namespace {

constexpr std::size_t kLeaf = 12;  // points that are looked at one by one

}  // namespace

struct PointTree::Search {
  glm::vec3 from;
  float squared;  // distance to the nearest so far
  std::size_t nearest;
};

PointTree::PointTree(std::vector<glm::vec3> points) : points_(std::move(points)), axes_(points_.size()) {
  build(0, points_.size());
}

void PointTree::build(std::size_t begin, std::size_t end) {
  if (end - begin <= kLeaf) return;
  const auto at = [this](std::size_t i) { return points_.begin() + static_cast<std::ptrdiff_t>(i); };
  glm::vec3 low = points_[begin];
  glm::vec3 high = low;
  for (std::size_t i = begin; i < end; ++i) {
    low = glm::min(low, points_[i]);
    high = glm::max(high, points_[i]);
  }
  const glm::vec3 extent = high - low;
  int axis = extent.y > extent.x ? 1 : 0;
  if (extent.z > extent[axis]) axis = 2;
  const std::size_t middle = begin + (end - begin) / 2;
  std::nth_element(at(begin), at(middle), at(end),
                   [axis](const glm::vec3& a, const glm::vec3& b) { return a[axis] < b[axis]; });
  axes_[middle] = static_cast<std::uint8_t>(axis);
  build(begin, middle);
  build(middle + 1, end);
}

void PointTree::look(Search& search, std::size_t begin, std::size_t end) const {
  const auto try_point = [&](std::size_t i) {
    const glm::vec3 way = points_[i] - search.from;
    const float squared = glm::dot(way, way);
    if (squared >= search.squared) return;
    search.squared = squared;
    search.nearest = i;
  };
  if (end - begin <= kLeaf) {
    for (std::size_t i = begin; i < end; ++i) try_point(i);
    return;
  }
  const std::size_t middle = begin + (end - begin) / 2;
  const int axis = axes_[middle];
  const float beyond = search.from[axis] - points_[middle][axis];
  try_point(middle);
  if (beyond < 0.0F) {
    look(search, begin, middle);
  } else {
    look(search, middle + 1, end);
  }
  if (beyond * beyond >= search.squared) return;
  if (beyond < 0.0F) {
    look(search, middle + 1, end);
  } else {
    look(search, begin, middle);
  }
}

float PointTree::distance(glm::vec3 from, std::size_t& hint) const {
  const glm::vec3 way = points_[hint] - from;
  Search search{from, glm::dot(way, way), hint};
  look(search, 0, points_.size());
  hint = search.nearest;
  return std::sqrt(search.squared);
}

}  // namespace tidemark::solver
