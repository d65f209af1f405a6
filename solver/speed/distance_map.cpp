#include "solver/speed/distance_map.h"

#include <algorithm>
#include <utility>

#include "core/index_walk.h"

namespace tidemark::solver {
namespace {

class DistanceMap final : public SpeedFunction {
 public:
  DistanceMap(Field distance, double within) : distance_(std::move(distance)), within_(within) {}

  void evaluate(const VoxelBox& box, double* share) const override {
    for_each_index(box.first, box.first + box.size, [&](Index3 voxel) {
      *share++ = std::clamp(-static_cast<double>(distance_.at(voxel)) / within_, -1.0, 1.0);
    });
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
