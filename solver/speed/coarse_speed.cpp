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
template <class Value>
void average(const VoxelBox& voxels, Index3 factor, const Value* values, Value* means) {
  for (std::int64_t z = 0; z < voxels.size.z; z += factor.z) {
    for (std::int64_t y = 0; y < voxels.size.y; y += factor.y) {
      for (std::int64_t x = 0; x < voxels.size.x; x += factor.x) {
        const Index3 size = glm::min(factor, voxels.size - Index3(x, y, z));
        Value sum(0);
        for (std::int64_t k = z; k < z + size.z; ++k) {
          for (std::int64_t j = y; j < y + size.y; ++j) {
            const Value* const row = values + x + voxels.size.x * (j + voxels.size.y * k);
            for (std::int64_t i = 0; i < size.x; ++i) sum += row[i];
          }
        }
        *means++ = scaled(sum, 1.0 / static_cast<double>(size.x * size.y * size.z));
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
