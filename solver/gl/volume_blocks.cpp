#include "solver/gl/volume_blocks.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <iterator>
#include <utility>

namespace tidemark::solver {

Result<VolumeBlocks> VolumeBlocks::create(gpu::Device& device, Index3 volume_size,
                                          std::vector<gpu::TexelFormat> formats, std::string label) {
  const PageLayout layout(volume_size, kDefaultPageShape);
  VolumeBlocks blocks;
  blocks.table_.assign(static_cast<std::size_t>(layout.page_count()), kEmptyTile);
  auto table = gpu::Texture3D::create(device, gpu::TexelFormat::r32i, layout.pages(),
                                      std::as_bytes(std::span(blocks.table_)), label);
  if (!table) return pass_on(table);
  blocks.table_texture_ = std::move(*table);
  auto textures = PackedTextures::create(device, PackedLayout(layout, device.capabilities()), blocks.used_,
                                         std::move(formats), std::move(label));
  if (!textures) return pass_on(textures);
  blocks.textures_ = std::move(*textures);
  blocks.write_empty_tile();
  TIDEMARK_TRY(device.check("making a volume of blocks"));
  return blocks;
}

void VolumeBlocks::write_empty_tile() {
  constexpr std::size_t kLargestTexel = 16;
  const std::vector<std::byte> zeros(kLargestTexel * static_cast<std::size_t>(layout().voxels_per_page()));
  for (std::size_t texture = 0; texture < textures_.count(); ++texture)
    textures_.upload(texture, std::array{kEmptyTile}, [&](std::size_t) { return zeros.data(); });
}

// Ample, so that blocks which come one after another seldom wait for room.
std::int64_t VolumeBlocks::capacity_for(std::int64_t tiles) const {
  if (tiles <= textures_.capacity()) return textures_.capacity();
  const std::int64_t all = layout().page_count() + 1;
  return textures_.layout().ample(tiles, std::min(tiles + tiles / 4, std::max(tiles, all)));
}

std::int64_t VolumeBlocks::bytes_with(std::int64_t more) const {
  const std::int64_t tiles = used_ + std::max<std::int64_t>(more - std::ssize(free_), 0);
  return textures_.bytes_for(capacity_for(tiles)) +
         static_cast<std::int64_t>(table_.size() * sizeof(PhysicalPage));
}

Status VolumeBlocks::write(gpu::Device& device, std::span<const std::int64_t> blocks,
                           std::span<const PackedTextures::Texels> texels) {
  const auto is_new = [&](std::int64_t block) {
    return table_[static_cast<std::size_t>(block)] == kEmptyTile;
  };
  const std::int64_t more = std::ranges::count_if(blocks, is_new) - std::ssize(free_);
  if (const std::int64_t tiles = used_ + more; tiles > textures_.capacity())
    TIDEMARK_TRY(textures_.grow(device, capacity_for(tiles)));
  std::vector<PhysicalPage> tiles;
  tiles.reserve(blocks.size());
  for (const std::int64_t block : blocks) {
    PhysicalPage& tile = table_[static_cast<std::size_t>(block)];
    if (tile == kEmptyTile && free_.empty()) {
      tile = used_++;
    } else if (tile == kEmptyTile) {
      tile = free_.back();
      free_.pop_back();
    }
    tiles.push_back(tile);
  }
  for (std::size_t texture = 0; texture < textures_.count(); ++texture)
    textures_.upload(texture, tiles, texels[texture]);
  upload_table(blocks);
  return device.check("writing a volume of blocks");
}

// The box of the table that the blocks lie in.
void VolumeBlocks::upload_table(std::span<const std::int64_t> blocks) {
  if (blocks.empty()) return;
  Index3 first = layout().page_coordinates(blocks.front());
  Index3 last = first;
  for (const std::int64_t block : blocks) {
    first = glm::min(first, layout().page_coordinates(block));
    last = glm::max(last, layout().page_coordinates(block));
  }
  const Index3 size = last - first + Index3(1);
  std::vector<PhysicalPage> box;
  box.reserve(static_cast<std::size_t>(size.x * size.y * size.z));
  for (std::int64_t z = first.z; z <= last.z; ++z) {
    for (std::int64_t y = first.y; y <= last.y; ++y)
      std::copy_n(table_.begin() + layout().page_number({first.x, y, z}), size.x, std::back_inserter(box));
  }
  table_texture_.upload(first, size, std::as_bytes(std::span(box)));
}

void VolumeBlocks::remove(std::span<const std::int64_t> blocks) {
  std::vector<std::int64_t> were_there;
  for (const std::int64_t block : blocks) {
    PhysicalPage& tile = table_[static_cast<std::size_t>(block)];
    if (tile == kEmptyTile) continue;
    free_.push_back(std::exchange(tile, kEmptyTile));
    were_there.push_back(block);
  }
  upload_table(were_there);
}

void VolumeBlocks::clear() {
  free_.clear();
  if (std::exchange(used_, kEmptyTile + 1) == kEmptyTile + 1) return;
  std::ranges::fill(table_, kEmptyTile);
  table_texture_.upload(Index3(0), layout().pages(), std::as_bytes(std::span(table_)));
}

gpu::Defines VolumeBlocks::defines() const {
  const PackedLayout& packed = textures_.layout();
  return {{"BLOCK_TILE_COLUMNS", fmt::to_string(packed.tile_columns())},
          {"BLOCKS_PER_ROW", fmt::to_string(packed.pages_per_row())},
          {"BLOCK_ROWS_PER_LAYER", fmt::to_string(packed.rows_per_layer())}};
}

void VolumeBlocks::bind(int unit) const {
  for (std::size_t texture = 0; texture < textures_.count(); ++texture)
    textures_[texture].bind(static_cast<unsigned>(unit) + static_cast<unsigned>(texture));
  table_texture_.bind(static_cast<unsigned>(unit) + static_cast<unsigned>(textures_.count()));
}

}  // namespace tidemark::solver
