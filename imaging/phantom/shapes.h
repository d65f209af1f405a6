// Signed distances (mm, < 0 inside) of simple bodies, and what to build from them.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tidemark::imaging::phantom {

inline double ball(const glm::dvec3& p, const glm::dvec3& centre, double radius) {
  return glm::length(p - centre) - radius;
}

// Exact for a ball and on the surface, close to it elsewhere. At the centre itself some -radius.
inline double ellipsoid(const glm::dvec3& p, const glm::dvec3& centre, const glm::dvec3& radii) {
  const glm::dvec3 per_radius = 1.0 / radii;
  const glm::dvec3 scaled = (p - centre) * per_radius;
  const double k0 = glm::length(scaled);
  const double k1 = glm::length(scaled * per_radius);
  if (k1 < 1e-9) return -std::min({radii.x, radii.y, radii.z});
  return k0 * (k0 - 1.0) / k1;
}

// A tube with round ends whose radius goes from radius_a at a to radius_b at b.
inline double capsule(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, double radius_a,
                      double radius_b) {
  const glm::dvec3 along = b - a;
  const double t = std::clamp(glm::dot(p - a, along) / glm::dot(along, along), 0.0, 1.0);
  return glm::length(p - a - t * along) - (radius_a + t * (radius_b - radius_a));
}

// The union of two bodies with a rounded seam, the radius of which is a quarter of `blend` and up.
inline double smooth_union(double a, double b, double blend) {
  const double h = std::max(blend - std::abs(a - b), 0.0) / blend;
  return std::min(a, b) - h * h * blend * 0.25;
}

// The union, or the intersection, with the edge where they meet turned into a fillet of that radius.
// Distances stay exact where the two boundaries are at right angles.
inline double round_union(double a, double b, double radius) {
  const glm::dvec2 u(std::max(radius - a, 0.0), std::max(radius - b, 0.0));
  return std::max(radius, std::min(a, b)) - glm::length(u);
}
inline double round_intersection(double a, double b, double radius) {
  return -round_union(-a, -b, radius);
}

// The part of a voxel of that size which lies inside a boundary at that distance: 1 deep inside, 0.5 on it,
// 0 outside, with the gentle edge of a scanner's point spread.
inline double coverage(double distance, double voxel_mm = 1.0) {
  const double t = std::clamp(0.5 - distance / (1.5 * voxel_mm), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

// The content of a voxel, painted from the outside in.
class Mixture {
 public:
  explicit Mixture(double value) : value_(value) {}

  // Covers `share` (0..1) of the voxel with a tissue; `wanted` when it belongs to the ground truth.
  void paint(double tissue_value, double share, bool wanted = false) {
    value_ += share * (tissue_value - value_);
    wanted_ += share * ((wanted ? 1.0 : 0.0) - wanted_);
  }

  [[nodiscard]] double value() const { return value_; }
  [[nodiscard]] bool inside() const { return wanted_ >= 0.5; }

 private:
  double value_;
  double wanted_ = 0.0;  // the share that belongs to the ground truth
};

}  // namespace tidemark::imaging::phantom
