// One step of the equation in a box of a dense volume, vectorised.
#pragma once

#include <cstdint>
#include <string>

#include "core/geometry.h"
#include "solver/model.h"

namespace tidemark::bench {

// Arrays of equal layout: voxel (x, y, z) lies at x + y * row + z * slice from `phi`, which points behind a
// margin of at least one voxel before each axis and, along x, of kDenseMargin behind it.
struct DenseStep {
  const float* phi = nullptr;
  const float* data = nullptr;  // how far the data term moves the surface in a step
  float* next = nullptr;
  std::int64_t row = 0;
  std::int64_t slice = 0;
  std::int64_t length = 0;  // voxels of a row; up to kDenseMargin - 1 more are written
  const solver::StepConstants<float>* constants = nullptr;
};
inline constexpr std::int64_t kDenseMargin = 16;

// Computes the rows y in [begin.y, end.y), z in [begin.z, end.z), whole, for isotropic spacing, with the
// widest instruction set that the processor has.
void step_dense(const DenseStep& step, Index3 begin, Index3 end);

}  // namespace tidemark::bench
