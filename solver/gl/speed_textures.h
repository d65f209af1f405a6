// D of a speed function, and its velocity where it has one, as a volume on the GPU: the processor fills it
// block by block where it is read.
#pragma once

#include <memory>

#include "gpu/program.h"
#include "solver/gl/filled_blocks.h"

namespace tidemark::solver {

// D is quantised as CachedSpeed does: two bytes a voxel of the blocks that are there, and sixteen more with a
// velocity.
class SpeedTextures {
 public:
  SpeedTextures() = default;
  // `threads` as in ExecutorOptions. Without `velocity` that is left out.
  explicit SpeedTextures(Index3 volume_size, int threads, bool velocity = true);

  // The function that blocks are evaluated from. Nothing is there of another one. The present one stays if it
  // fails (ErrorKind::capability) because memory is short.
  Status set_function(gpu::Device& device, std::shared_ptr<const SpeedFunction> function);
  // What a voxel takes, that is there, or would be.
  [[nodiscard]] static std::int64_t bytes_per_voxel(const SpeedFunction& function);

  // After set_function(): what is wanted, and how much memory that takes.
  [[nodiscard]] FilledBlocks& wanted() { return volume_; }
  [[nodiscard]] const FilledBlocks& wanted() const { return volume_; }
  // Evaluates what was asked for and is not there. `most_bytes` as in VolumeBlocks::reserve(). Fails
  // (ErrorKind::capability) when memory is short.
  Status fill(gpu::Device& device, std::int64_t most_bytes = VolumeBlocks::kAnyBytes);

  // SPEED_VOLUME and ADVECTION; kUnits units from `unit` on.
  static constexpr int kUnits = 3;
  [[nodiscard]] gpu::Defines defines() const;
  void set_uniforms(const gpu::Program& program, int unit) const;

 private:
  Index3 volume_size_{0};
  int threads_ = 0;
  bool wants_velocity_ = true;
  std::shared_ptr<const SpeedFunction> function_;
  FilledBlocks volume_;
  bool has_velocity_ = false;
};

}  // namespace tidemark::solver
