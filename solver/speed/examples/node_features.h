// The features of one scale: what the values around a node look like, by numbers that no rotation changes.
#pragma once

#include <vector>

#include "solver/speed/examples/scale_space.h"

namespace tidemark::solver {

enum NodeFeature {
  value,            // Gaussian-smoothed, less the pyramid's centre
  deviation,        // standard deviation within the Gaussian
  gradient,         // magnitude, per mm
  hessian_largest,  // eigenvalues, per mm^2
  hessian_middle,
  hessian_smallest,
  structure_largest,  // roots of the eigenvalues of the structure tensor, per mm
  structure_middle,
  structure_smallest,
  kNodeFeatures
};

// The nodes that features read on either side.
inline constexpr std::int64_t kFeatureReach = 2;

// From moments that hold kFeatureReach more nodes on each side: kNodeFeatures arrays of all nodes of these
// moments' box. Those in the reach hold anything.
void node_features(const Moments& moments, glm::dvec3 step_mm, std::vector<float>& features);

}  // namespace tidemark::solver
