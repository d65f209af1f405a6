// Volumes on the GPU of which only some blocks are there: memory follows what shaders read, not the volume
// (resources/shaders/solver/volume_blocks.glsl).
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "core/paging/page_layout.h"
#include "gpu/program.h"
#include "solver/gl/packed_textures.h"

namespace tidemark::solver {

// Blocks are of kDefaultPageShape. Texels of blocks that are not there are 0.
class VolumeBlocks {
 public:
  static constexpr std::int64_t kAnyBytes = std::numeric_limits<std::int64_t>::max();

  VolumeBlocks() = default;
  // A texture for each format. No block is there. Fails (ErrorKind::capability) when the driver's limits or
  // its memory are too small.
  static Result<VolumeBlocks> create(gpu::Device& device, Index3 volume_size,
                                     std::vector<gpu::TexelFormat> formats, std::string label);

  [[nodiscard]] const PageLayout& layout() const { return textures_.layout().layout(); }
  [[nodiscard]] const std::vector<gpu::TexelFormat>& formats() const { return textures_.formats(); }
  [[nodiscard]] std::int64_t bytes() const { return bytes_for(textures_.capacity()); }
  // The least that is needed to write such blocks, with the copy while the textures grow.
  [[nodiscard]] std::int64_t bytes_to_write(std::span<const std::int64_t> blocks) const;

  // Makes room for blocks that are to be written: with some to spare where that stays below `most_bytes`, the
  // copy included. On failure (ErrorKind::capability) all is as before.
  Status reserve(gpu::Device& device, std::span<const std::int64_t> blocks,
                 std::int64_t most_bytes = kAnyBytes);
  // Writes all texels of some blocks, x fastest; `texels[t](i)` are those of the i-th block in texture t.
  // Fails (ErrorKind::capability) when memory is short.
  Status write(gpu::Device& device, std::span<const std::int64_t> blocks,
               std::span<const PackedTextures::Texels> texels);
  // They are there no more; others take their places.
  void remove(std::span<const std::int64_t> blocks);
  // No block is there, and the memory goes back.
  Status release(gpu::Device& device);

  // The defines of volume_blocks.glsl; the textures in units from `unit` on, and the table behind them.
  [[nodiscard]] gpu::Defines defines() const;
  void bind(int unit) const;

 private:
  static constexpr PhysicalPage kEmptyTile = 0;  // of all blocks that are not there
  [[nodiscard]] std::int64_t bytes_for(std::int64_t capacity) const;
  [[nodiscard]] bool is_there(std::int64_t block) const {
    return table_[static_cast<std::size_t>(block)] != kEmptyTile;
  }
  [[nodiscard]] std::int64_t tiles_with(std::span<const std::int64_t> blocks) const;
  void upload_table(std::span<const std::int64_t> blocks);

  PackedTextures textures_;
  std::vector<PhysicalPage> table_;  // a block's tile
  gpu::Texture3D table_texture_;
  std::vector<PhysicalPage> free_;  // tiles that were used
  PhysicalPage used_ = kEmptyTile + 1;
};

// Takes the values of a box of whole blocks, x fastest, to one block after another. The last blocks along an
// axis may end early, at the volume's end.
template <class T>
void to_blocks(Index3 box, const T* values, T* blocks) {
  constexpr Index3 kShape = kDefaultPageShape;
  for (std::int64_t row = 0; row < box.y * box.z; ++row, values += box.x) {
    T* to = blocks + (row % box.y + kShape.y * (row / box.y)) * kShape.x;
    for (std::int64_t x = 0; x < box.x; x += kShape.x, to += kShape.x * kShape.y * kShape.z)
      std::copy_n(values + x, std::min(kShape.x, box.x - x), to);
  }
}

}  // namespace tidemark::solver
