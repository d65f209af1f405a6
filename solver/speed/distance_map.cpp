#include "solver/speed/distance_map.h"

#include <algorithm>
#include <utility>

namespace tidemark::solver {
namespace {

class DistanceMap final : public SpeedFunction {
 public:
  DistanceMap(Field distance, double within) : distance_(std::move(distance)), within_(within) {}

  void evaluate(const VoxelBox& box, double* share) const override {
    for (std::int64_t z = 0; z < box.size.z; ++z) {
      for (std::int64_t y = 0; y < box.size.y; ++y) {
        for (std::int64_t x = 0; x < box.size.x; ++x) {
          const auto distance = static_cast<double>(distance_.at(box.first + Index3(x, y, z)));
          *share++ = std::clamp(-distance / within_, -1.0, 1.0);
        }
      }
    }
  }

 private:
  Field distance_;
  double within_;  // in units of the smallest spacing
};

}  // namespace

std::shared_ptr<const SpeedFunction> distance_map(Field distance, double within) {
  return std::make_shared<DistanceMap>(std::move(distance), within);
}

}  // namespace tidemark::solver
