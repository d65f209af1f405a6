#include "renderer/host/map_samples.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/index_walk.h"
#include "renderer/host/trilinear.h"
#include "renderer/plane_blocks.h"

namespace tidemark::renderer {
namespace {

constexpr int kShift = 3;
constexpr int kSide = 1 << kShift;  // of a block
constexpr std::size_t kBlockVoxels = 512;
constexpr std::size_t kLongestRun = 8;  // blocks, as in CachedSpeed
constexpr std::int32_t kMissing = -1;
constexpr std::int32_t kWanted = -2;

}  // namespace

MapSamples::MapSamples(Index3 volume_size)
    : blocks_(volume_size, kDefaultPageShape), size_(volume_size), grid_(blocks_.pages()) {}

void MapSamples::set_function(std::shared_ptr<const solver::SpeedFunction> function) {
  if (function == function_) return;
  function_ = std::move(function);
  places_.clear();
  wanted_.clear();
  filled_ = 0;
  values_ = {};
  if (is_evaluated()) places_.assign(static_cast<std::size_t>(blocks_.page_count()), kMissing);
}

void MapSamples::want(const solver::VoxelBox& box) {
  for_each_page(blocks_, box.first, box.first + box.size, [&](Index3 coordinates) {
    const std::int64_t block = blocks_.page_number(coordinates);
    std::int32_t& place = places_[static_cast<std::size_t>(block)];
    if (place != kMissing) return;
    wanted_.push_back(block);
    place = kWanted;
  });
}

void MapSamples::fill_plane(const glm::dmat4& voxel_from_view, ThreadPool& threads) {
  if (!is_evaluated()) return;
  for (const Index3 voxel : blocks_on_plane(blocks_, voxel_from_view)) want({voxel, Index3(1)});
  fill(threads);
}

void MapSamples::fill_pages(const PageLayout& layout, std::span<const std::int64_t> pages,
                            ThreadPool& threads) {
  if (!is_evaluated()) return;
  for (const std::int64_t page : pages) want({layout.first_voxel(page), layout.valid_shape(page)});
  fill(threads);
}

std::vector<MapSamples::Run> MapSamples::runs_of_wanted() const {
  std::vector<Run> runs;
  for (std::size_t i = 0; i < wanted_.size(); ++i) {
    const bool follows = i > 0 && wanted_[i] == wanted_[i - 1] + 1 && wanted_[i] % grid_.x != 0 &&
                         runs.back().blocks < kLongestRun;
    if (follows) {
      ++runs.back().blocks;
    } else {
      runs.push_back({i, 1});
    }
  }
  return runs;
}

// `values`: of the run's first block.
void MapSamples::evaluate(const Run& run, float* values) const {
  solver::VoxelBox box{blocks_.first_voxel(wanted_[run.first]), blocks_.valid_shape(wanted_[run.first])};
  const std::int64_t last = wanted_[run.first + run.blocks - 1];
  box.size.x = blocks_.first_voxel(last).x + blocks_.valid_shape(last).x - box.first.x;
  std::vector<double> evaluated(static_cast<std::size_t>(box.voxels()));
  function_->evaluate(box, evaluated.data());
  const double* next = evaluated.data();
  for (std::int64_t z = 0; z < box.size.z; ++z) {
    for (std::int64_t y = 0; y < box.size.y; ++y) {
      float* row = values + kSide * (y + kSide * z);
      for (std::int64_t x = 0; x < box.size.x; ++x) {
        row[x % kSide + x / kSide * static_cast<std::int64_t>(kBlockVoxels)] = static_cast<float>(*next++);
      }
    }
  }
}

void MapSamples::fill(ThreadPool& threads) {
  if (wanted_.empty()) return;
  std::sort(wanted_.begin(), wanted_.end());
  const std::size_t begin = static_cast<std::size_t>(filled_);
  values_.resize((begin + wanted_.size()) * kBlockVoxels);
  const std::vector<Run> runs = runs_of_wanted();
  threads.for_each(std::ssize(runs), 1, [&](std::int64_t first, std::int64_t end, int) {
    for (std::int64_t i = first; i < end; ++i) {
      const Run& run = runs[static_cast<std::size_t>(i)];
      evaluate(run, values_.data() + (begin + run.first) * kBlockVoxels);
    }
  });
  for (const std::int64_t block : wanted_) places_[static_cast<std::size_t>(block)] = filled_++;
  wanted_.clear();
}

// Null where the block is missing.
const float* MapSamples::value_at(glm::ivec3 voxel) const {
  // Not negative: shifts are what divisions would be.
  const glm::ivec3 block = voxel >> kShift;
  const std::int32_t place = places_[static_cast<std::size_t>(number_in(grid_, block))];
  if (place < 0) return nullptr;
  const glm::ivec3 local = voxel & (kSide - 1);
  return values_.data() + static_cast<std::size_t>(place) * kBlockVoxels +
         static_cast<std::size_t>(number_in(glm::ivec3(kSide), local));
}

float MapSamples::at(glm::ivec3 voxel) const {
  const float* value = value_at(glm::clamp(voxel, glm::ivec3(0), size_ - 1));
  return value != nullptr ? *value : 0.0F;
}

float MapSamples::between(glm::vec3 position) const {
  const Trilinear around(position, size_);
  const glm::ivec3 local = around.low & (kSide - 1);
  float corner[8];
  if (std::max({local.x, local.y, local.z}) < kSide - 1) {
    // All eight in one block, as most are.
    const float* first = value_at(around.low);
    if (first == nullptr) return 0.0F;
    for (int i = 0; i < 8; ++i) {
      corner[i] = first[(i & 1) + (i & 2 ? kSide : 0) + (i & 4 ? kSide * kSide : 0)];
    }
  } else {
    const glm::ivec3 high = glm::min(around.low + 1, size_ - 1);
    for (int i = 0; i < 8; ++i) {
      const float* value = value_at(
          {i & 1 ? high.x : around.low.x, i & 2 ? high.y : around.low.y, i & 4 ? high.z : around.low.z});
      corner[i] = value != nullptr ? *value : 0.0F;
    }
  }
  return around.mean(corner);
}

}  // namespace tidemark::renderer
