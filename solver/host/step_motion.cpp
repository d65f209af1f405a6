#include "solver/host/data_motion.h"

#include <algorithm>

#include "solver/host/row_masks.h"

// After the standard headers: defines functions of these names.
#include "solver/speed/data-inl.h"

namespace tidemark::solver {

void fill_data_motion(const Volume& source, const StepConstants<double>& constants, Index3 first,
                      Index3 valid, float* motion) {
  std::fill_n(motion, kPageVoxels, 0.0F);
  std::visit(
      [&](const auto& stored) {
        for (std::int64_t z = 0; z < valid.z; ++z) {
          for (std::int64_t y = 0; y < valid.y; ++y) {
            const auto* row = stored.data() + source.geometry.offset(first + Index3(0, y, z));
            float* to = motion + (y + kPageSide * z) * kPageSide;
            for (std::int64_t x = 0; x < valid.x; ++x) {
              const double value = source.slope * static_cast<double>(row[x]) + source.intercept;
              to[x] = static_cast<float>(HWY_NAMESPACE::data_motion(value, constants));
            }
          }
        }
      },
      source.voxels);
}

}  // namespace tidemark::solver
