// A volume on the GPU that the processor fills block by block where it is read, so that nothing is made for
// the volume as a whole.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/thread_pool.h"
#include "solver/gl/volume_blocks.h"
#include "solver/speed/speed_function.h"

namespace tidemark::solver {

class FilledBlocks {
 public:
  FilledBlocks() = default;
  // As VolumeBlocks. `threads` as in ExecutorOptions.
  static Result<FilledBlocks> create(gpu::Device& device, Index3 volume_size,
                                     std::vector<gpu::TexelFormat> formats, std::string label, int threads);

  // Asks for the blocks that a box inside of the volume touches.
  void want(const VoxelBox& box);
  // ... for those of the pages and of all that are at most `reach` pages away. Layout and reach are always
  // the same.
  void want_around(const PageLayout& layout, std::span<const std::int64_t> pages, Index3 reach);

  // Makes the texels of a box of whole blocks side by side along x: those of texture t, block after block as
  // to_blocks() has them, go to `texels[t]`, where they are 0. Called on several threads.
  using Filler = std::function<void(const VoxelBox& box, std::span<std::byte* const> texels)>;
  // Fills what was asked for and is not there. `most_bytes` as in VolumeBlocks::reserve(). Fails
  // (ErrorKind::capability) when memory is short; nothing counts as there then.
  Status fill(gpu::Device& device, const Filler& filler, std::int64_t most_bytes = VolumeBlocks::kAnyBytes);
  // Nothing counts as there, and nothing is asked for. The memory is kept for what comes next.
  void forget();
  // The same, and the memory goes back.
  Status release(gpu::Device& device);

  [[nodiscard]] std::int64_t bytes() const { return blocks_.bytes(); }
  // What fill() needs at least.
  [[nodiscard]] std::int64_t bytes_wanted() const { return blocks_.bytes_to_write(wanted_); }
  [[nodiscard]] const VolumeBlocks& blocks() const { return blocks_; }

 private:
  struct Run;
  [[nodiscard]] std::vector<Run> take_wanted();
  Status write(gpu::Device& device, std::span<const Run> runs, const Filler& filler);

  VolumeBlocks blocks_;
  std::shared_ptr<ThreadPool> threads_;
  std::vector<bool> there_;  // by block; those that are wanted are on their way
  std::vector<std::int64_t> wanted_;
  std::vector<bool> surrounded_;  // by page: everything around it was asked for
};

}  // namespace tidemark::solver
