#include "solver/gl/volume_blocks.h"

#include <array>
#include <glm/common.hpp>
#include <iterator>
#include <utility>

namespace tidemark::solver {

Result<VolumeBlocks> VolumeBlocks::create(gpu::Device& device, Index3 volume_size,
                                          std::vector<gpu::TexelFormat> formats, std::string label) {
  const PageLayout layout(volume_size, kDefaultPageShape);
  const PackedLayout packed(layout, device.capabilities());
  VolumeBlocks blocks;
  blocks.table_.assign(static_cast<std::size_t>(layout.page_count()), kEmptyTile);
  auto table = gpu::Texture3D::create(device, gpu::TexelFormat::r32i, layout.pages(),
                                      std::as_bytes(std::span(blocks.table_)), label);
  if (!table) return pass_on(table);
  blocks.table_texture_ = std::move(*table);
  auto textures = PackedTextures::create(device, packed, packed.without_power_of_two(blocks.used_),
                                         std::move(formats), std::move(label));
  if (!textures) return pass_on(textures);
  blocks.textures_ = std::move(*textures);
  constexpr std::size_t kLargestTexel = 16;
  const std::vector<std::byte> zeros(kLargestTexel * static_cast<std::size_t>(layout.voxels_per_page()));
  for (std::size_t texture = 0; texture < blocks.textures_.count(); ++texture)
    blocks.textures_.upload(texture, std::array{kEmptyTile}, [&](std::size_t) { return zeros.data(); });
  TIDEMARK_TRY(device.check("making a volume of blocks"));
  return blocks;
}

std::int64_t VolumeBlocks::bytes_for(std::int64_t capacity) const {
  return textures_.bytes_for(capacity) + static_cast<std::int64_t>(table_.size() * sizeof(PhysicalPage));
}

// How many tiles are in use when the blocks are there, too; the empty one counts.
std::int64_t VolumeBlocks::tiles_with(std::span<const std::int64_t> blocks) const {
  const std::int64_t more =
      std::ranges::count_if(blocks, [&](std::int64_t block) { return !is_there(block); });
  return used_ + std::max<std::int64_t>(more - std::ssize(free_), 0);
}

std::int64_t VolumeBlocks::bytes_to_write(std::span<const std::int64_t> blocks) const {
  const std::int64_t tiles = tiles_with(blocks);
  return tiles <= textures_.capacity() ? bytes() : bytes_for(tiles) + textures_.bytes();
}

Status VolumeBlocks::reserve(gpu::Device& device, std::span<const std::int64_t> blocks,
                             std::int64_t most_bytes) {
  const std::int64_t tiles = tiles_with(blocks);
  if (tiles <= textures_.capacity()) return {};
  const PackedLayout& packed = textures_.layout();
  const std::int64_t all = layout().page_count() + 1;
  const std::int64_t ample =
      packed.without_power_of_two(packed.ample(tiles, std::max(tiles, std::min(tiles + tiles / 4, all))));
  return textures_.grow(device, bytes_for(ample) + textures_.bytes() <= most_bytes ? ample : tiles);
}

Status VolumeBlocks::write(gpu::Device& device, std::span<const std::int64_t> blocks,
                           std::span<const PackedTextures::Texels> texels) {
  TIDEMARK_TRY(reserve(device, blocks));
  std::vector<PhysicalPage> tiles;
  std::vector<std::int64_t> placed;
  tiles.reserve(blocks.size());
  for (const std::int64_t block : blocks) {
    PhysicalPage& tile = table_[static_cast<std::size_t>(block)];
    if (tile == kEmptyTile) {
      placed.push_back(block);
      if (free_.empty()) {
        tile = used_++;
      } else {
        tile = free_.back();
        free_.pop_back();
      }
    }
    tiles.push_back(tile);
  }
  for (std::size_t texture = 0; texture < textures_.count(); ++texture)
    textures_.upload(texture, tiles, texels[texture]);
  upload_table(placed);
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
  std::ranges::copy_if(blocks, std::back_inserter(were_there),
                       [&](std::int64_t block) { return is_there(block); });
  for (const std::int64_t block : were_there)
    free_.push_back(std::exchange(table_[static_cast<std::size_t>(block)], kEmptyTile));
  upload_table(were_there);
}

Status VolumeBlocks::release(gpu::Device& device) {
  auto anew = create(device, layout().domain_size(), formats(), textures_.label());
  if (!anew) return pass_on(anew);
  *this = std::move(*anew);
  return {};
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
