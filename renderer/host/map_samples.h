// A map that a speed function evaluates, D, its doubt or the surface's motion, where a picture shows it.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "core/paging/page_layout.h"
#include "core/thread_pool.h"
#include "solver/speed/speed_function.h"

namespace tidemark::renderer {

class MapSamples {
 public:
  explicit MapSamples(Index3 volume_size);

  // Null, or a tent: pictures compute D from the source, and there is nothing here.
  void set_function(std::shared_ptr<const solver::SpeedFunction> function);
  // The tent, if that is what drives the surface.
  [[nodiscard]] const solver::Tent* tent() const { return function_ ? function_->tent() : nullptr; }
  [[nodiscard]] bool is_evaluated() const { return function_ != nullptr && tent() == nullptr; }

  // Evaluates the blocks of 8^3 voxels around the plane of a slice picture (from the view, x and y in -1..1,
  // to voxel coordinates), or in pages of a layout, unless they are there. They throw what the function
  // throws, and may be called again then.
  void fill_plane(const glm::dmat4& voxel_from_view, ThreadPool& threads);
  void fill_pages(const PageLayout& layout, std::span<const std::int64_t> pages, ThreadPool& threads);

  // Of a voxel of a block that is there, clamped to the volume; 0 elsewhere.
  [[nodiscard]] float at(glm::ivec3 voxel) const;
  // Trilinear; voxel coordinates, integers at voxel centres.
  [[nodiscard]] float between(glm::vec3 position) const;

 private:
  // Blocks that lie side by side along x are evaluated together.
  struct Run {
    std::size_t first;  // in wanted_
    std::size_t blocks;
  };
  [[nodiscard]] const float* value_at(glm::ivec3 voxel) const;  // inside of the volume
  void want(const solver::VoxelBox& box);
  [[nodiscard]] std::vector<Run> runs_of_wanted() const;
  void evaluate(const Run& run, float* values) const;
  void fill(ThreadPool& threads);

  PageLayout blocks_;
  glm::ivec3 size_{0};  // voxels
  glm::ivec3 grid_{0};  // blocks
  std::shared_ptr<const solver::SpeedFunction> function_;
  std::vector<std::int32_t> places_;  // of each block in values_, or kMissing or kWanted
  std::vector<std::int64_t> wanted_;
  std::int32_t filled_ = 0;    // blocks
  std::vector<float> values_;  // 512 a block
};

}  // namespace tidemark::renderer
