// A phantom as a problem for an executor.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "imaging/filters/filters.h"
#include "imaging/phantom/phantom.h"
#include "solver/distance_transform.h"
#include "solver/executor.h"

namespace tidemark::test {

struct PhantomProblem {
  imaging::Phantom phantom;  // without its volume
  std::shared_ptr<const Volume> source;
  solver::Parameters parameters;

  static Result<PhantomProblem> make(const std::string& kind) {
    auto phantom = imaging::make_phantom(kind);
    if (!phantom) return pass_on(phantom);
    PhantomProblem problem;
    problem.source = std::make_shared<const Volume>(std::exchange(phantom->volume, {}));
    problem.phantom = std::move(*phantom);
    problem.parameters.target = problem.phantom.target;
    problem.parameters.range = problem.phantom.range;
    problem.parameters.alpha = problem.phantom.alpha;
    return problem;
  }

  // The voxel in the middle of the seed.
  [[nodiscard]] glm::dvec3 middle() const {
    const auto& [i, j, k, radius_mm] = *phantom.seed;
    return {i, j, k};
  }

  // From its threshold, or else from its seed.
  Status begin(solver::Executor& level_set) const {
    if (phantom.init_threshold) {
      const auto& [low, high] = *phantom.init_threshold;
      return level_set.restore(
          solver::distance_transform(imaging::between(*source, low, high), level_set.band()));
    }
    const auto& [i, j, k, radius_mm] = *phantom.seed;
    return level_set.paint(solver::sphere_at_voxel(source->geometry, {i, j, k}, radius_mm),
                           solver::Brush::add);
  }
};

}  // namespace tidemark::test
