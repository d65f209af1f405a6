// Problems drawn by chance, for comparisons of executors with the reference.
#pragma once

#include <random>

#include "level_sets.h"
#include "tests/support/support.h"

namespace tidemark::test {

inline double uniform_number(std::mt19937& random, double low, double high) {
  return low + (high - low) * (random() / 4294967296.0);
}

// T, epsilon and alpha, both schemes, both forms of the data term, and now and then without a term.
inline solver::Parameters random_parameters(std::mt19937& random) {
  const auto uniform = [&](double low, double high) { return uniform_number(random, low, high); };
  solver::Parameters p;
  p.target = uniform(60, 160);
  p.range = uniform(5, 80);
  p.alpha = random() % 8 == 0 ? (random() % 2 == 0 ? 0.0 : 1.0) : uniform(0, 1);
  p.scheme = random() % 4 == 0 ? solver::Scheme::paper : solver::Scheme::split;
  p.data_form = random() % 4 == 0 ? solver::DataForm::raw : solver::DataForm::clamped;
  p.data_term = random() % 8 != 0;
  p.curvature_term = random() % 8 != 0;
  return p;
}

struct RandomProblem {
  std::shared_ptr<const Volume> source;
  solver::Parameters parameters;
};

// A lumpy source with noise, random parameters and random spacing. Braces fix the order in which the numbers
// are drawn, which compilers choose for arguments in parentheses.
inline RandomProblem random_problem(std::mt19937& random) {
  const auto uniform = [&](double low, double high) { return uniform_number(random, low, high); };
  RandomProblem problem;
  const Index3 size{random() % 20 + 20, random() % 20 + 20, random() % 16 + 12};
  const glm::dvec3 spacing{uniform(0.4, 1.2), uniform(0.4, 1.2), random() % 2 == 0 ? 1.0 : uniform(0.8, 3.0)};
  const Geometry geometry = grid(size, spacing);
  const glm::dvec3 a{uniform(0.1, 0.5), uniform(0.1, 0.5), uniform(0.1, 0.5)};
  const glm::dvec3 b{uniform(0, 6), uniform(0, 6), uniform(0, 6)};
  const double noise = uniform(0, 20);
  problem.source = volume_of(geometry, [&](glm::dvec3 p) {
    return 100.0 + 80.0 * std::sin(a.x * p.x + b.x) * std::sin(a.y * p.y + b.y) * std::sin(a.z * p.z + b.z) +
           uniform(-noise, noise);
  });
  problem.parameters = random_parameters(random);
  return problem;
}

inline void seed(solver::Executor& level_set, const Geometry& geometry, std::mt19937& random) {
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 voxel{random() % static_cast<unsigned>(geometry.size.x),
                           random() % static_cast<unsigned>(geometry.size.y),
                           random() % static_cast<unsigned>(geometry.size.z)};
    const auto brush = i == 2 ? solver::Brush::erase : solver::Brush::add;
    const double radius = 2.0 + random() % 6;
    if (!level_set.paint(solver::sphere_at_voxel(geometry, voxel, radius), brush)) qFatal("paint failed");
  }
}

// Whether a voxel's six one-sided differences are all zero.
inline bool is_flat(const std::vector<double>& phi, const Geometry& g, Index3 v) {
  const double here = phi[static_cast<std::size_t>(g.offset(v))];
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {-1, 1}) {
      Index3 other = v;
      other[axis] = std::clamp<std::int64_t>(v[axis] + side, 0, g.size[axis] - 1);
      if (phi[static_cast<std::size_t>(g.offset(other))] != here) return false;
    }
  }
  return true;
}

inline bool resident_pages_cover_what_is_not_flat(const solver::Field& field,
                                                  const std::vector<double>& phi) {
  const Geometry& g = field.geometry;
  for (std::int64_t i = 0; i < g.voxel_count(); ++i) {
    const Index3 v = g.voxel_at(i);
    const std::int64_t page = field.layout.translate(v).page;
    if (!field.pages.is_stored(page) && !is_flat(phi, g, v)) return false;
  }
  return true;
}

}  // namespace tidemark::test
