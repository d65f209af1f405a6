#include "solver/speed/coarse_speed.h"

#include <algorithm>
#include <glm/common.hpp>
#include <vector>

namespace tidemark::solver {
namespace {

// The voxels of the fine grid in the blocks of a box.
VoxelBox voxels_of(const VoxelBox& blocks, const CoarseGrid& grid) {
  const Index3 first = grid.first_of(blocks.first);
  const Index3 end = glm::min(grid.first_of(blocks.first + blocks.size), grid.fine().size);
  return {first, end - first};
}

double scaled(double value, double factor) {
  return value * factor;
}
glm::vec3 scaled(const glm::vec3& value, double factor) {
  return value * static_cast<float>(factor);
}

template <class Value>
void average(const VoxelBox& blocks, const VoxelBox& voxels, const CoarseGrid& grid,
             const std::vector<Value>& values, Value* means) {
  std::vector<double> counts(static_cast<std::size_t>(blocks.voxels()), 0.0);
  std::fill_n(means, blocks.voxels(), Value(0));
  std::size_t next = 0;
  for (std::int64_t k = 0; k < voxels.size.z; ++k) {
    for (std::int64_t j = 0; j < voxels.size.y; ++j) {
      const std::int64_t row = blocks.size.x * (j / grid.factor().y + blocks.size.y * (k / grid.factor().z));
      for (std::int64_t i = 0; i < voxels.size.x; ++i) {
        const std::int64_t block = row + i / grid.factor().x;
        means[block] += values[next++];
        counts[static_cast<std::size_t>(block)] += 1.0;
      }
    }
  }
  for (std::size_t block = 0; block < counts.size(); ++block) {
    means[block] = scaled(means[block], 1.0 / counts[block]);
  }
}

}  // namespace

void CoarseSpeed::evaluate(const VoxelBox& box, double* speed) const {
  const VoxelBox voxels = voxels_of(box, grid_);
  std::vector<double> values(static_cast<std::size_t>(voxels.voxels()));
  fine_->evaluate(voxels, values.data());
  average(box, voxels, grid_, values, speed);
}

void CoarseSpeed::evaluate_advection(const VoxelBox& box, glm::vec3* velocity) const {
  const VoxelBox voxels = voxels_of(box, grid_);
  std::vector<glm::vec3> values(static_cast<std::size_t>(voxels.voxels()));
  fine_->evaluate_advection(voxels, values.data());
  average(box, voxels, grid_, values, velocity);
}

std::shared_ptr<const SpeedFunction> CoarseSpeed::following(const Field& phi) const {
  const double band = phi.band * grid_.scale();
  auto next = fine_->following(refined(phi, grid_, band, kDefaultPageShape));
  return next == nullptr ? nullptr : std::make_shared<const CoarseSpeed>(std::move(next), grid_);
}

}  // namespace tidemark::solver
