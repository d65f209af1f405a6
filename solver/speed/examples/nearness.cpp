#include "solver/speed/examples/nearness.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace tidemark::solver {
namespace {

// Of each class: neighbours in a stroke are nearly as far.
constexpr std::size_t kMostPoints = 2000;

float squared(glm::vec3 v) {
  return glm::dot(v, v);
}

std::vector<glm::vec3> points_of(const std::vector<std::int64_t>& stroke, const Geometry& geometry) {
  const Index3 size = geometry.size;
  const std::size_t count = std::min(stroke.size(), kMostPoints);
  std::vector<glm::vec3> points;
  points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t offset = stroke[i * stroke.size() / count];
    const Index3 voxel(offset % size.x, offset / size.x % size.y, offset / (size.x * size.y));
    points.push_back(glm::vec3(voxel) * glm::vec3(geometry.spacing_mm));
  }
  return points;
}

// Those of the points that may be the nearest one of any place between low and high. The slack is for
// rounding, so that a voxel's nearest point is among them in every box.
std::vector<glm::vec3> near_to(const std::vector<glm::vec3>& points, glm::vec3 low, glm::vec3 high) {
  constexpr float kSlack = 1.001F;
  float least = std::numeric_limits<float>::max();
  for (const glm::vec3& p : points) {
    least = std::min(least, squared(glm::max(glm::abs(p - low), glm::abs(p - high))));
  }
  std::vector<glm::vec3> near;
  for (const glm::vec3& p : points) {
    if (squared(p - glm::clamp(p, low, high)) <= kSlack * least) near.push_back(p);
  }
  return near;
}

// Squared distances to the nearest of the points, of all voxels of a box.
std::vector<float> distances(const std::vector<glm::vec3>& points, const VoxelBox& box, glm::vec3 spacing) {
  std::vector<float> nearest(static_cast<std::size_t>(box.voxels()), std::numeric_limits<float>::max());
  std::vector<float> along_x(static_cast<std::size_t>(box.size.x));
  for (const glm::vec3& p : points) {
    for (std::size_t x = 0; x < along_x.size(); ++x) {
      const float d = static_cast<float>(box.first.x + static_cast<std::int64_t>(x)) * spacing.x - p.x;
      along_x[x] = d * d;
    }
    float* row = nearest.data();
    for (std::int64_t z = 0; z < box.size.z; ++z) {
      const float dz = static_cast<float>(box.first.z + z) * spacing.z - p.z;
      for (std::int64_t y = 0; y < box.size.y; ++y, row += box.size.x) {
        const float dy = static_cast<float>(box.first.y + y) * spacing.y - p.y;
        const float across = dy * dy + dz * dz;
        for (std::int64_t x = 0; x < box.size.x; ++x) {
          const float d = across + along_x[static_cast<std::size_t>(x)];
          row[x] = d < row[x] ? d : row[x];
        }
      }
    }
  }
  return nearest;
}

}  // namespace

Nearness::Nearness(const Strokes& strokes, const Geometry& geometry)
    : spacing_mm_(geometry.spacing_mm),
      inside_(points_of(strokes.inside, geometry)),
      outside_(points_of(strokes.outside, geometry)) {}

void Nearness::evaluate(const VoxelBox& box, float* nearness) const {
  const glm::vec3 low = glm::vec3(box.first) * spacing_mm_;
  const glm::vec3 high = glm::vec3(box.first + box.size - Index3(1)) * spacing_mm_;
  const std::vector<float> inside = distances(near_to(inside_, low, high), box, spacing_mm_);
  const std::vector<float> outside = distances(near_to(outside_, low, high), box, spacing_mm_);
  for (std::size_t i = 0; i < inside.size(); ++i) {
    const float in = std::sqrt(inside[i]);
    const float out = std::sqrt(outside[i]);
    nearness[i] = (out - in) / (out + in);
  }
}

}  // namespace tidemark::solver
