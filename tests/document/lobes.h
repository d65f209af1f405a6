// Bodies with and without a neck through which a front leaks, drawn by lot.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <memory>
#include <random>
#include <vector>

#include "core/volume.h"
#include "solver/parameters.h"
#include "solver/sphere.h"

namespace tidemark::test {

// Voxels of 1 mm, so that voxels and mm are the same here.
struct Lobes {
  std::shared_ptr<const Volume> volume;
  solver::Parameters parameters;
  solver::Sphere seed;
  // Where a voxel lies behind the neck; none where there is no neck.
  std::function<bool(Index3)> behind;
  double neck_mm = 0.0;  // its radius
};

// In cm's of numbers: uniform in [low, high].
class Lot {
 public:
  explicit Lot(unsigned number) : generator_(number) {}
  double operator()(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_()) / static_cast<double>(generator_.max());
  }
  double normal() {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) sum += (*this)(0.0, 1.0);
    return sum;
  }

 private:
  std::mt19937 generator_;
};

// Signed distances in mm, below 0 inside.
inline double ellipsoid_distance(glm::dvec3 p, glm::dvec3 centre, glm::dvec3 radii) {
  const glm::dvec3 scaled = (p - centre) / radii;
  return (glm::length(scaled) - 1.0) * std::min({radii.x, radii.y, radii.z});
}
inline double tube_distance(glm::dvec3 p, glm::dvec3 a, glm::dvec3 b, double radius) {
  const glm::dvec3 along = b - a;
  const double t = std::clamp(glm::dot(p - a, along) / glm::dot(along, along), 0.0, 1.0);
  return glm::length(p - a - t * along) - radius;
}

inline Lobes painted(Lot& lot, Index3 size, const std::function<double(glm::dvec3)>& distance) {
  const double noise = 600.0 * lot(0.0, 0.08);
  auto volume = std::make_shared<Volume>();
  volume->geometry.size = size;
  std::vector<std::int16_t> voxels;
  for (std::int64_t offset = 0; offset < volume->geometry.voxel_count(); ++offset) {
    const double inside =
        std::clamp(0.5 - distance(glm::dvec3(volume->geometry.voxel_at(offset))) / 1.5, 0.0, 1.0);
    voxels.push_back(static_cast<std::int16_t>(200.0 + 600.0 * inside + noise * lot.normal()));
  }
  volume->voxels = std::move(voxels);
  Lobes lobes;
  lobes.volume = std::move(volume);
  lobes.parameters.target = 800.0;
  lobes.parameters.range = 300.0;
  lobes.parameters.alpha = lot(0.7, 0.9);
  return lobes;
}

// A body and another behind a neck of 2 to 4 mm radius and 4 to 10 mm length.
inline Lobes lobes_with_neck(unsigned number) {
  Lot lot(number);
  const glm::dvec3 body(lot(14, 20), lot(14, 22), lot(14, 22));
  const glm::dvec3 other(lot(12, 18), lot(12, 20), lot(12, 20));
  const double gap = lot(4, 10);
  const double radius = lot(2.0, 4.0);
  const glm::dvec3 centre(body.x + 6, 32, 32);
  const glm::dvec3 there(centre.x + body.x + gap + other.x, 32 + lot(-5, 5), 32 + lot(-5, 5));
  Lobes lobes = painted(lot, {112, 64, 64}, [=](glm::dvec3 p) {
    return std::min({ellipsoid_distance(p, centre, body), ellipsoid_distance(p, there, other),
                     tube_distance(p, centre, there, radius)});
  });
  lobes.seed = {centre + glm::dvec3(lot(-4, 2), lot(-4, 4), lot(-4, 4)), lot(4, 8)};
  lobes.neck_mm = radius;
  lobes.behind = [=](Index3 voxel) { return ellipsoid_distance(glm::dvec3(voxel), there, other) < 0.0; };
  return lobes;
}

// By turns: a long body, a body with a wide waist, a body with vessels, a body with holes.
inline Lobes lobes_without_neck(unsigned number) {
  Lot lot(1000 + number);
  const Index3 size{112, 64, 64};
  const glm::dvec3 centre(56, 32, 32);
  const glm::dvec3 body(lot(14, 22), lot(14, 22), lot(14, 22));
  std::function<double(glm::dvec3)> distance;
  glm::dvec3 seed = centre + glm::dvec3(lot(-5, 5), lot(-5, 5), lot(-5, 5));
  switch (number % 4) {
    case 0: {
      const glm::dvec3 radii(lot(30, 45), lot(12, 18), lot(12, 18));
      distance = [=](glm::dvec3 p) { return ellipsoid_distance(p, centre, radii); };
      seed.x = centre.x + lot(-20, 20);
      break;
    }
    case 1: {
      const double apart = lot(0.4, 0.65);
      const glm::dvec3 step(body.x * apart, 0, 0);
      distance = [=](glm::dvec3 p) {
        return std::min(ellipsoid_distance(p, centre - step, body),
                        ellipsoid_distance(p, centre + step, body));
      };
      seed -= step;
      break;
    }
    case 2: {
      const glm::dvec3 right{100, lot(20, 44), lot(20, 44)};
      const glm::dvec3 left{12, lot(20, 44), lot(20, 44)};
      const double radius = lot(2.5, 4.0);
      distance = [=](glm::dvec3 p) {
        return std::min({ellipsoid_distance(p, centre, body), tube_distance(p, centre, right, radius),
                         tube_distance(p, centre, left, radius)});
      };
      break;
    }
    default: {
      std::vector<glm::dvec3> holes;
      for (int i = 0; i < 12; ++i) {
        holes.push_back(centre + glm::dvec3(lot(-15, 15), lot(-15, 15), lot(-15, 15)));
      }
      const double radius = lot(1.5, 3.0);
      distance = [=](glm::dvec3 p) {
        double d = ellipsoid_distance(p, centre, body);
        for (const glm::dvec3& hole : holes) {
          if (glm::length(hole - seed) > 10.0) d = std::max(d, radius - glm::length(p - hole));
        }
        return d;
      };
    }
  }
  Lobes lobes = painted(lot, size, distance);
  lobes.seed = {seed, lot(4, 8)};
  return lobes;
}

}  // namespace tidemark::test
