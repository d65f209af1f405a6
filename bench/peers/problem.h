// The problem that every contestant solves: source, parameters and start.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/volume.h"
#include "imaging/phantom/phantom.h"
#include "solver/parameters.h"
#include "solver/sphere.h"

namespace tidemark::bench {

// A volume with 1 mm voxels, the equation's parameters, and one of the two starts.
struct Problem {
  std::string name;
  std::shared_ptr<const Volume> source;
  std::vector<float> values;  // the source in voxel order, rescaled, for peers that want floats
  Mask truth;
  solver::Parameters parameters;
  std::optional<solver::Sphere> seed;
  std::optional<Mask> start;
};

// The phantom of that kind with its own parameters and start.
Result<Problem> make_problem(std::string_view phantom_kind, const imaging::PhantomOptions& options = {});

// The start as a signed distance in voxels, > 0 inside, clamped to +-band; in voxel order.
std::vector<float> start_distance(const Problem& problem, double band);

}  // namespace tidemark::bench
