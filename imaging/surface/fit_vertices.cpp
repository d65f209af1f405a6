#include "imaging/surface/fit_vertices.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace tidemark::imaging {
namespace {

// Below this slope (1 is that of a distance) a step along the gradient says nothing.
constexpr double kLeastSlope = 0.3;

// The mean of second differences, but at most twice the least; 0 when their signs differ.
class Bend {
 public:
  void add(double difference) {
    low_ = std::min(low_, difference);
    sum_ += difference;
    ++count_;
    high_ = std::max(high_, difference);
  }
  [[nodiscard]] double limited() const {
    if (low_ > high_) return 0.0;  // none was added
    const double mean = sum_ / count_;
    return low_ > 0.0 ? std::min(mean, 2.0 * low_) : high_ < 0.0 ? std::max(mean, 2.0 * high_) : 0.0;
  }

 private:
  double low_ = std::numeric_limits<double>::infinity();
  double high_ = -std::numeric_limits<double>::infinity();
  double sum_ = 0.0;
  int count_ = 0;
};

struct Sample {
  double phi;           // in units of the smallest spacing
  glm::dvec3 gradient;  // per smallest spacing along i, j, k: of length 1 for a distance
};

// phi between the voxels: trilinear, bent along each axis by the smallest second difference of the eight
// voxels around, and by none where they differ in sign (Min and Gibou, J. Comput. Phys. 225, 2007,
// section 2.3). It follows curved surfaces as a cubic does, and does not overshoot at the ridges of thin
// structures.
class SmoothField {
 public:
  explicit SmoothField(const PhiValues& phi)
      : size_(phi.geometry().size), phi_(phi), scale_(smallest(phi) / phi.geometry().spacing_mm) {}

  // Voxels per smallest spacing along i, j, k.
  [[nodiscard]] glm::dvec3 scale() const { return scale_; }

  [[nodiscard]] Index3 size() const { return size_; }

  // Whether some but not all corners of a cell are inside; beyond the border its voxels go on.
  [[nodiscard]] bool mixed(glm::dvec3 cell) const {
    int inside = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const Index3 v = Index3(cell) + Index3(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1);
      const Index3 voxel = glm::clamp(v, Index3(0), size_ - Index3(1));
      inside += at(voxel) > 0.0;
    }
    return inside != 0 && inside != 8;
  }

  [[nodiscard]] Sample sample(glm::dvec3 p) const {
    const Index3 last = size_ - Index3(1);
    p = glm::clamp(p, glm::dvec3(0.0), glm::dvec3(last));
    const Index3 base = glm::max(glm::min(Index3(glm::floor(p)), last - Index3(1)), Index3(0));
    const glm::dvec3 t = p - glm::dvec3(base);
    std::array<Bend, 3> bends;
    Sample sum{0.0, glm::dvec3(0.0)};
    for (int corner = 0; corner < 8; ++corner) {
      const Index3 side(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1);
      const Index3 v = glm::min(base + side, last);
      const glm::dvec3 weight = glm::mix(1.0 - t, t, glm::dvec3(side));
      const double value = at(v);
      sum.phi += weight.x * weight.y * weight.z * value;
      const glm::dvec3 slope = glm::dvec3(side) * 2.0 - 1.0;
      sum.gradient +=
          value * slope * glm::dvec3(weight.y * weight.z, weight.x * weight.z, weight.x * weight.y);
      for (int axis = 0; axis < 3; ++axis) {
        if (v[axis] == 0 || v[axis] == last[axis]) continue;  // no second difference at the border
        Index3 step(0);
        step[axis] = 1;
        bends[static_cast<std::size_t>(axis)].add(at(v - step) - 2.0 * value + at(v + step));
      }
    }
    for (int axis = 0; axis < 3; ++axis) {
      const double bend = bends[static_cast<std::size_t>(axis)].limited();
      sum.phi -= 0.5 * bend * t[axis] * (1.0 - t[axis]);
      sum.gradient[axis] -= 0.5 * bend * (1.0 - 2.0 * t[axis]);
    }
    sum.gradient *= scale_;
    return sum;
  }

 private:
  static double smallest(const PhiValues& phi) {
    const glm::dvec3& spacing = phi.geometry().spacing_mm;
    return std::min({spacing.x, spacing.y, spacing.z});
  }
  [[nodiscard]] double at(Index3 v) const { return static_cast<double>(phi_.at(v)); }

  Index3 size_;
  const PhiValues& phi_;
  glm::dvec3 scale_;
};

// Where a vertex may go.
struct Place {
  glm::dvec3 cell;  // the lowest corner of the cell that it stays in
  glm::dvec3 axes;  // 1 where it may move, 0 where it is held on the outer face of the border voxels
  bool inner;       // it may move along all axes

  [[nodiscard]] glm::dvec3 clamp(glm::dvec3 p) const { return glm::clamp(p, cell, cell + 1.0); }
};

// Finds the vertex's place and puts it on the outer face if it belongs to a cap.
Place move_to_surface(const SmoothField& field, glm::dvec3& vertex) {
  Place place{glm::floor(vertex), glm::dvec3(1.0), true};
  for (int axis = 0; axis < 3; ++axis) {
    const auto last = static_cast<double>(field.size()[axis] - 1);
    if (vertex[axis] == last && last > 0.0) place.cell[axis] = last - 1.0;
    if (place.cell[axis] >= 0.0 && place.cell[axis] < last) continue;
    vertex[axis] = place.cell[axis] < 0.0 ? -0.5 : last + 0.5;
    place.axes[axis] = 0.0;
    place.inner = false;
  }
  if (!place.inner && !field.mixed(place.cell)) place.axes = glm::dvec3(0.0);  // amid a cap
  return place;
}

// Two Newton steps to phi = 0, each taken only when it brings phi nearer to 0.
void project(const SmoothField& field, const Place& place, glm::dvec3& vertex) {
  Sample here = field.sample(vertex);
  for (int step = 0; step < 2; ++step) {
    const glm::dvec3 gradient = here.gradient * place.axes;
    const double slope2 = glm::dot(gradient, gradient);
    if (slope2 < kLeastSlope * kLeastSlope) return;
    const glm::dvec3 next = place.clamp(vertex - here.phi / slope2 * gradient * field.scale());
    const Sample there = field.sample(next);
    if (!(std::abs(there.phi) < std::abs(here.phi))) return;
    vertex = next;
    here = there;
  }
}

// phi at the middles of a triangle's edges, whose mean is that of a quadratic over the triangle.
double mean_phi(const SmoothField& field, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
  return (field.sample(0.5 * (a + b)).phi + field.sample(0.5 * (b + c)).phi +
          field.sample(0.5 * (c + a)).phi) /
         3.0;
}

}  // namespace

void fit_vertices(const PhiValues& phi, const std::vector<std::array<std::uint32_t, 3>>& triangles,
                  std::vector<glm::dvec3>& vertices) {
  const SmoothField field(phi);
  std::vector<Place> places;
  places.reserve(vertices.size());
  for (glm::dvec3& vertex : vertices) {
    places.push_back(move_to_surface(field, vertex));
    project(field, places.back(), vertex);
  }
  // Area-weighted means over the triangles around each vertex.
  std::vector<double> sums(vertices.size(), 0.0);
  std::vector<double> areas(vertices.size(), 0.0);
  for (const auto& [a, b, c] : triangles) {
    if (!places[a].inner || !places[b].inner || !places[c].inner) continue;
    const glm::dvec3 ab = (vertices[b] - vertices[a]) / field.scale();
    const glm::dvec3 ac = (vertices[c] - vertices[a]) / field.scale();
    const double area = glm::length(glm::cross(ab, ac));
    const double mean = mean_phi(field, vertices[a], vertices[b], vertices[c]);
    for (const std::uint32_t v : {a, b, c}) {
      sums[v] += area * mean;
      areas[v] += area;
    }
  }
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (!(areas[v] > 0.0)) continue;
    const Sample here = field.sample(vertices[v]);
    const double slope2 = glm::dot(here.gradient, here.gradient);
    if (slope2 < kLeastSlope * kLeastSlope) continue;
    // phi is `mean` too high around here, so the surface moves to where it is that much lower.
    const double mean = sums[v] / areas[v];
    vertices[v] = places[v].clamp(vertices[v] - mean / slope2 * here.gradient * field.scale());
  }
}

}  // namespace tidemark::imaging
