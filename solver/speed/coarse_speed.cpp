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

// The mean of each block's voxels, one block after the other. Blocks at the end of an axis may be incomplete.
// A row of blocks at once: their sums do not wait for each other.
template <class Value>
void average(const VoxelBox& voxels, Index3 factor, const Value* values, Value* means) {
  const std::int64_t blocks = (voxels.size.x + factor.x - 1) / factor.x;
  for (std::int64_t z = 0; z < voxels.size.z; z += factor.z) {
    for (std::int64_t y = 0; y < voxels.size.y; y += factor.y) {
      const Index3 size = glm::min(factor, voxels.size - Index3(0, y, z));
      std::fill_n(means, blocks, Value(0));
      for (std::int64_t k = z; k < z + size.z; ++k) {
        for (std::int64_t j = y; j < y + size.y; ++j) {
          const Value* const row = values + voxels.size.x * (j + voxels.size.y * k);
          for (std::int64_t i = 0; i < factor.x; ++i) {
            const std::int64_t count = (voxels.size.x - i + factor.x - 1) / factor.x;
            for (std::int64_t b = 0; b < count; ++b) means[b] += row[factor.x * b + i];
          }
        }
      }
      for (std::int64_t b = 0; b < blocks; ++b, ++means) {
        const std::int64_t width = std::min(factor.x, voxels.size.x - factor.x * b);
        *means = scaled(*means, 1.0 / static_cast<double>(width * size.y * size.z));
      }
    }
  }
}

}  // namespace

void CoarseSpeed::evaluate(const VoxelBox& box, double* speed) const {
  const VoxelBox voxels = voxels_of(box, grid_);
  std::vector<double> values(static_cast<std::size_t>(voxels.voxels()));
  fine_->evaluate(voxels, values.data());
  average(voxels, grid_.factor(), values.data(), speed);
}

void CoarseSpeed::evaluate_advection(const VoxelBox& box, glm::vec3* velocity) const {
  const VoxelBox voxels = voxels_of(box, grid_);
  std::vector<glm::vec3> values(static_cast<std::size_t>(voxels.voxels()));
  fine_->evaluate_advection(voxels, values.data());
  average(voxels, grid_.factor(), values.data(), velocity);
  std::for_each_n(velocity, box.voxels(), [&](glm::vec3& v) { v = scaled(v, velocity_factor_); });
}

std::shared_ptr<const SpeedFunction> CoarseSpeed::following(const Field& phi) const {
  const double band = phi.band * grid_.scale();
  auto next = fine_->following(refined(phi, grid_, band, kDefaultPageShape));
  if (next == nullptr) return nullptr;
  return std::make_shared<const CoarseSpeed>(std::move(next), grid_, velocity_factor_);
}

}  // namespace tidemark::solver
