// D of a speed function, and its velocity where it has one, as textures over the volume: the processor fills
// them block by block where they are read, so that nothing is evaluated for the volume as a whole.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/paging/page_layout.h"
#include "core/thread_pool.h"
#include "gpu/program.h"
#include "gpu/texture.h"
#include "solver/speed/speed_function.h"

namespace tidemark::solver {

// Blocks are of 8^3 voxels. D is quantised as CachedSpeed does. Two bytes a voxel of the volume, and sixteen
// more with a velocity.
class SpeedTextures {
 public:
  SpeedTextures() = default;
  // `threads` as in ExecutorOptions. Without `velocity` that is left out. Fails (ErrorKind::capability) when
  // the volume is beyond the driver's limit or its memory.
  static Result<SpeedTextures> create(gpu::Device& device, Index3 volume_size, int threads,
                                      bool velocity = true);

  // The function that the blocks are evaluated from; the present one stays if it fails
  // (ErrorKind::capability). Nothing is there of another one.
  Status set_function(gpu::Device& device, std::shared_ptr<const SpeedFunction> function);
  [[nodiscard]] const std::shared_ptr<const SpeedFunction>& function() const { return function_; }
  [[nodiscard]] static std::int64_t bytes_for(Index3 volume_size, bool velocity);

  // Asks for the blocks that a box inside of the volume touches.
  void want(const VoxelBox& box);
  // ... for those of the pages and of all that are at most `reach` pages away. Layout and reach are always
  // the same.
  void want_around(const PageLayout& layout, std::span<const std::int64_t> pages, Index3 reach);
  // Evaluates what was asked for and is not there. Fails (ErrorKind::capability) when memory is short.
  Status fill(gpu::Device& device);

  // SPEED_VOLUME and ADVECTION; two units from `unit` on.
  [[nodiscard]] gpu::Defines defines() const;
  void set_uniforms(const gpu::Program& program, int unit) const;

 private:
  // Blocks that lie side by side along x are evaluated and written together.
  struct Run;
  [[nodiscard]] std::vector<Run> take_wanted();
  void evaluate(std::span<Run> runs) const;
  Status write(gpu::Device& device, std::vector<Run> runs);
  void forget();

  PageLayout blocks_;
  std::shared_ptr<const SpeedFunction> function_;
  std::shared_ptr<ThreadPool> threads_;
  gpu::Texture3D speed_;
  gpu::Texture3D velocity_;
  bool wants_velocity_ = true;
  bool has_velocity_ = false;  // memory for one
  std::vector<bool> there_;    // by block; those that are wanted are on their way
  std::vector<std::int64_t> wanted_;
  std::vector<bool> surrounded_;  // by page: everything around it was asked for
};

}  // namespace tidemark::solver
