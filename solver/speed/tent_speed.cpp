#include "solver/speed/tent_speed.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tidemark::solver {

Tent tent_of(const Parameters& parameters) {
  if (parameters.data_form == DataForm::raw) {
    return {parameters.target, parameters.range, 1.0, std::numeric_limits<double>::lowest()};
  }
  return {parameters.target, 1.0, 1.0 / parameters.range, -1.0};
}

TentSpeed::TentSpeed(std::shared_ptr<const Volume> source, const Parameters& parameters)
    : source_(std::move(source)), tent_(tent_of(parameters)) {}

double TentSpeed::largest() const {
  if (!tent_.is_raw()) return 1.0;
  const auto [low, high] = source_->range();
  const auto raw = [&](double value) { return tent_.peak - std::abs(value - tent_.target); };
  return std::max({std::abs(raw(low)), std::abs(raw(high)), tent_.peak});
}

void TentSpeed::evaluate(const VoxelBox& box, double* speed) const {
  const Tent tent = tent_;
  std::visit(
      [&](const auto& stored) {
        for (std::int64_t z = 0; z < box.size.z; ++z) {
          for (std::int64_t y = 0; y < box.size.y; ++y) {
            const auto* row = stored.data() + source_->geometry.offset(box.first + Index3(0, y, z));
            for (std::int64_t x = 0; x < box.size.x; ++x) {
              const double value = source_->slope * static_cast<double>(row[x]) + source_->intercept;
              *speed++ = std::max(tent.peak - std::abs(value - tent.target) * tent.slope, tent.floor);
            }
          }
        }
      },
      source_->voxels);
}

}  // namespace tidemark::solver
