#include "solver/gl/filled_blocks.h"

#include <glm/common.hpp>
#include <utility>

#include "core/index_walk.h"
#include "core/without_exceptions.h"

namespace tidemark::solver {
namespace {

constexpr std::int64_t kLongestRun = 8;  // blocks, as in CachedSpeed
// Made before they are written: bounds the memory on the way.
constexpr std::size_t kRunsAtATime = 512;

}  // namespace

// Blocks that lie side by side along x are made together.
struct FilledBlocks::Run {
  VoxelBox box;
  std::int64_t first_block = 0;
  std::int64_t count = 0;
};

Result<FilledBlocks> FilledBlocks::create(gpu::Device& device, Index3 volume_size,
                                          std::vector<gpu::TexelFormat> formats, std::string label,
                                          int threads) {
  FilledBlocks filled;
  auto blocks = VolumeBlocks::create(device, volume_size, std::move(formats), std::move(label));
  if (!blocks) return pass_on(blocks);
  filled.blocks_ = std::move(*blocks);
  filled.threads_ = std::make_shared<ThreadPool>(threads);
  filled.forget();
  return filled;
}

Status FilledBlocks::release(gpu::Device& device) {
  forget();
  return blocks_.release(device);
}

void FilledBlocks::forget() {
  there_.assign(static_cast<std::size_t>(blocks_.layout().page_count()), false);
  wanted_.clear();
  surrounded_.clear();
}

void FilledBlocks::want(const VoxelBox& box) {
  for_each_page(blocks_.layout(), box.first, box.first + box.size, [&](Index3 coordinates) {
    const std::int64_t block = blocks_.layout().page_number(coordinates);
    if (there_[static_cast<std::size_t>(block)]) return;
    there_[static_cast<std::size_t>(block)] = true;
    wanted_.push_back(block);
  });
}

void FilledBlocks::want_around(const PageLayout& layout, std::span<const std::int64_t> pages, Index3 reach) {
  surrounded_.resize(static_cast<std::size_t>(layout.page_count()));
  for (const std::int64_t page : pages) {
    if (surrounded_[static_cast<std::size_t>(page)]) continue;
    surrounded_[static_cast<std::size_t>(page)] = true;
    const Index3 coordinates = layout.page_coordinates(page);
    const Index3 low = glm::max(coordinates - reach, Index3(0)) * layout.page_shape();
    const Index3 high =
        glm::min((coordinates + reach + Index3(1)) * layout.page_shape(), layout.domain_size());
    want({low, high - low});
  }
}

std::vector<FilledBlocks::Run> FilledBlocks::take_wanted() {
  std::ranges::sort(wanted_);
  std::vector<Run> runs;
  for (const std::int64_t block : std::exchange(wanted_, {})) {
    const Index3 first = blocks_.layout().first_voxel(block);
    const Index3 valid = blocks_.layout().valid_shape(block);
    const bool follows = !runs.empty() && block == runs.back().first_block + runs.back().count &&
                         first.x != 0 && runs.back().count < kLongestRun;
    if (!follows) runs.push_back({{first, {0, valid.y, valid.z}}, block, 0});
    runs.back().box.size.x += valid.x;
    ++runs.back().count;
  }
  return runs;
}

Status FilledBlocks::fill(gpu::Device& device, const Filler& filler, std::int64_t most_bytes) {
  if (wanted_.empty()) return {};
  Status filled = without_exceptions([&]() -> Status {
    TIDEMARK_TRY(blocks_.reserve(device, wanted_, most_bytes));
    const std::vector<Run> runs = take_wanted();
    for (std::size_t first = 0; first < runs.size(); first += kRunsAtATime) {
      const std::size_t count = std::min(kRunsAtATime, runs.size() - first);
      TIDEMARK_TRY(write(device, std::span(runs).subspan(first, count), filler));
    }
    return {};
  });
  if (!filled) forget();
  return filled;
}

Status FilledBlocks::write(gpu::Device& device, std::span<const Run> runs, const Filler& filler) {
  std::vector<std::int64_t> numbers;
  std::vector<std::size_t> first_of_run;
  for (const Run& run : runs) {
    first_of_run.push_back(numbers.size());
    for (std::int64_t block = 0; block < run.count; ++block) numbers.push_back(run.first_block + block);
  }
  const std::size_t voxels = static_cast<std::size_t>(blocks_.layout().voxels_per_page());
  const std::size_t textures = blocks_.formats().size();
  std::vector<std::vector<std::byte>> texels(textures);
  std::vector<std::size_t> block_bytes(textures);
  std::vector<PackedTextures::Texels> of_block(textures);
  for (std::size_t t = 0; t < textures; ++t) {
    block_bytes[t] = voxels * static_cast<std::size_t>(gpu::bytes_per_texel(blocks_.formats()[t]));
    texels[t].resize(numbers.size() * block_bytes[t]);
    of_block[t] = [from = texels[t].data(), bytes = block_bytes[t]](std::size_t i) {
      return from + i * bytes;
    };
  }
  threads_->for_each(std::ssize(runs), 1, [&](std::int64_t begin, std::int64_t end, int) {
    std::vector<std::byte*> to(textures);
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      for (std::size_t t = 0; t < textures; ++t) to[t] = texels[t].data() + first_of_run[i] * block_bytes[t];
      filler(runs[i].box, to);
    }
  });
  return blocks_.write(device, numbers, of_block);
}

}  // namespace tidemark::solver
