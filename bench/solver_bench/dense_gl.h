// The level set without pages on the GPU: every voxel of the volume, every step.
#pragma once

#include <memory>

#include "core/volume.h"
#include "gpu/device.h"
#include "solver/field.h"
#include "solver/parameters.h"

namespace tidemark::bench {

struct DenseRun {
  std::int64_t steps = 0;
  double seconds = 0.0;
};

// Computes `steps` steps from `phi`. Fails (ErrorKind::capability) where the volume does not fit a buffer.
Result<DenseRun> run_dense_gl(gpu::Device& device, const Volume& source, const solver::Parameters& parameters,
                              const solver::Field& phi, std::int64_t steps);

}  // namespace tidemark::bench
