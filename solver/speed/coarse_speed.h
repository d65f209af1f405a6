// A speed function on a coarser grid: the mean of each block of voxels.
#pragma once

#include <memory>

#include "solver/coarse_grid.h"
#include "solver/speed/speed_function.h"

namespace tidemark::solver {

// The mean of D, and not D of the mean brightness: a block at an edge has none of the values between. D is in
// [-1, 1]. v is the mean velocity times a factor: see velocity_factor().
class CoarseSpeed final : public SpeedFunction {
 public:
  CoarseSpeed(std::shared_ptr<const SpeedFunction> fine, const CoarseGrid& grid, double velocity_factor)
      : fine_(std::move(fine)), grid_(grid), velocity_factor_(velocity_factor) {}

  void evaluate(const VoxelBox& box, double* speed) const override;
  [[nodiscard]] double largest() const override { return fine_->largest(); }
  [[nodiscard]] bool advects() const override { return fine_->advects(); }
  void evaluate_advection(const VoxelBox& box, glm::vec3* velocity) const override;
  [[nodiscard]] double fastest_advection() const override {
    return velocity_factor_ * fine_->fastest_advection();
  }
  [[nodiscard]] bool follows_surface() const override { return fine_->follows_surface(); }
  [[nodiscard]] std::shared_ptr<const SpeedFunction> following(const Field& phi) const override;

 private:
  std::shared_ptr<const SpeedFunction> fine_;
  CoarseGrid grid_;
  double velocity_factor_;
};

}  // namespace tidemark::solver
