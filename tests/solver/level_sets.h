// Volumes, level sets and measures with known answers, for the solver's tests.
#pragma once

#include <QtGlobal>
#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "core/volume.h"
#include "solver/executor.h"
#include "solver/field.h"

namespace tidemark::test {

using Function = std::function<double(glm::dvec3 mm)>;

inline Geometry grid(Index3 size, glm::dvec3 spacing = glm::dvec3(1.0)) {
  Geometry geometry;
  geometry.size = size;
  geometry.spacing_mm = spacing;
  return geometry;
}

inline glm::dvec3 centre_of(const Geometry& geometry) {
  return geometry.to_patient(0.5 * glm::dvec3(geometry.size - Index3(1)));
}

inline std::vector<float> sample(const Geometry& geometry, const Function& function) {
  std::vector<float> values;
  values.reserve(static_cast<std::size_t>(geometry.voxel_count()));
  for (std::int64_t z = 0; z < geometry.size.z; ++z) {
    for (std::int64_t y = 0; y < geometry.size.y; ++y) {
      for (std::int64_t x = 0; x < geometry.size.x; ++x) {
        values.push_back(static_cast<float>(function(geometry.to_patient({x, y, z}))));
      }
    }
  }
  return values;
}

inline std::shared_ptr<const Volume> volume_of(const Geometry& geometry, const Function& source) {
  auto volume = std::make_shared<Volume>();
  volume->geometry = geometry;
  volume->voxels = sample(geometry, source);
  return volume;
}

// A source that is 0 everywhere: with T = 0, D = 1 everywhere.
inline std::shared_ptr<const Volume> zero_volume(const Geometry& geometry) {
  return volume_of(geometry, [](glm::dvec3) { return 0.0; });
}

inline std::unique_ptr<solver::Executor> executor(solver::ExecutorKind kind,
                                                  std::shared_ptr<const Volume> source,
                                                  const solver::Parameters& parameters,
                                                  const solver::ExecutorOptions& options = {}) {
  auto made = solver::make_executor(kind, std::move(source), parameters, options);
  if (!made) qFatal("%s", made.error().message.c_str());
  return std::move(*made);
}

// Replaces phi by a function's values (in units of the smallest spacing), clamped to the band.
inline void set_phi(solver::Executor& level_set, const Geometry& geometry, const Function& phi) {
  const auto status =
      level_set.restore(solver::Field::from_dense(geometry, sample(geometry, phi), level_set.band()));
  if (!status) qFatal("%s", status.error().message.c_str());
}

inline solver::AdvanceReport run(solver::Executor& level_set, std::int64_t steps,
                                 bool until_converged = false) {
  solver::Advance request;
  request.steps = steps;
  request.until_converged = until_converged;
  auto report = level_set.advance(request);
  if (!report) qFatal("%s", report.error().message.c_str());
  return *report;
}

// Infinity where a value is not a number, or there are more of one than of the other.
inline double largest_difference(const auto& a, const auto& b) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (a.size() != b.size()) return kInfinity;
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i]));
    if (std::isnan(difference)) return kInfinity;
    largest = std::max(largest, difference);
  }
  return largest;
}
inline double largest_difference(const solver::Executor& a, const solver::Executor& b) {
  return largest_difference(a.snapshot().value().dense(), b.snapshot().value().dense());
}

// Calls visit(point in mm) for each crossing of phi = 0 along a grid line, by linear interpolation.
inline void for_each_crossing(const solver::Field& phi, const std::function<void(glm::dvec3)>& visit) {
  const Geometry& g = phi.geometry;
  for (std::int64_t z = 0; z < g.size.z; ++z) {
    for (std::int64_t y = 0; y < g.size.y; ++y) {
      for (std::int64_t x = 0; x < g.size.x; ++x) {
        const Index3 here(x, y, z);
        const double a = phi.at(here);
        for (int axis = 0; axis < 3; ++axis) {
          Index3 there = here;
          if (++there[axis] >= g.size[axis]) continue;
          const double b = phi.at(there);
          if ((a > 0.0) == (b > 0.0)) continue;
          glm::dvec3 point(here);
          point[axis] += a / (a - b);
          visit(g.to_patient(point));
        }
      }
    }
  }
}

// The mean distance of the surface's crossings from a point, in mm.
inline double mean_radius(const solver::Field& phi, glm::dvec3 centre) {
  double sum = 0.0;
  int count = 0;
  for_each_crossing(phi, [&](glm::dvec3 point) {
    sum += glm::distance(point, centre);
    ++count;
  });
  return count == 0 ? 0.0 : sum / count;
}

// The volume inside phi = 0 in voxels of the smallest spacing cubed, at sub-voxel precision (a linear ramp
// of one spacing stands for each voxel's share).
inline double smooth_volume(const solver::Field& phi) {
  double sum = 0.0;
  for (const float value : phi.dense()) sum += std::clamp(0.5 + static_cast<double>(value), 0.0, 1.0);
  return sum;
}

// The order of convergence between two resolutions.
inline double order(double coarse_error, double fine_error, double ratio) {
  return std::log(coarse_error / fine_error) / std::log(ratio);
}

}  // namespace tidemark::test
