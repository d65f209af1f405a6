#include "solver/host/step_motion.h"

#include <algorithm>
#include <array>

#include "solver/host/row_masks.h"

namespace tidemark::solver {
namespace {

// Calls visit(place in the page) for the valid voxels, x fastest.
template <class Visit>
void for_each_voxel(Index3 valid, Visit visit) {
  for (std::int64_t z = 0; z < valid.z; ++z) {
    for (std::int64_t y = 0; y < valid.y; ++y) {
      for (std::int64_t x = 0; x < valid.x; ++x) visit(x + kPageSide * (y + kPageSide * z));
    }
  }
}

}  // namespace

void fill_data_motion(const SpeedFunction& speed, const StepConstants<double>& constants, Index3 first,
                      Index3 valid, float* motion) {
  std::array<double, kPageVoxels> values;
  speed.evaluate({first, valid}, values.data());
  std::fill_n(motion, kPageVoxels, 0.0F);
  const double weight = constants.time_step * constants.data_weight;
  const double* value = values.data();
  for_each_voxel(valid, [&](std::int64_t at) { motion[at] = static_cast<float>(weight * *value++); });
}

void fill_advection(const SpeedFunction& speed, const StepConstants<double>& constants, Index3 first,
                    Index3 valid, float* motion) {
  std::array<glm::vec3, kPageVoxels> values;
  speed.evaluate_advection({first, valid}, values.data());
  std::fill_n(motion, 3 * kPageVoxels, 0.0F);
  const glm::vec3* value = values.data();
  for_each_voxel(valid, [&](std::int64_t at) {
    for (int axis = 0; axis < 3; ++axis) {
      const double per_step = constants.time_step * constants.inverse_spacing[axis];
      motion[axis * kPageVoxels + at] = static_cast<float>(per_step * static_cast<double>((*value)[axis]));
    }
    ++value;
  });
}

}  // namespace tidemark::solver
