// The tent: D = max(-1, 1 - |I - T| / epsilon), or the raw form epsilon - |I - T| (paper eq. 7).
#pragma once

#include <memory>

#include "solver/parameters.h"
#include "solver/speed/speed_function.h"

namespace tidemark::solver {

// T, epsilon and the form of `parameters` as numbers.
[[nodiscard]] Tent tent_of(const Parameters& parameters);

class TentSpeed final : public SpeedFunction {
 public:
  TentSpeed(std::shared_ptr<const Volume> source, const Parameters& parameters);

  void evaluate(const VoxelBox& box, double* speed) const override;
  // Of the raw form, from the range of the source, which takes a while.
  [[nodiscard]] double largest() const override;
  [[nodiscard]] const Tent* tent() const override { return &tent_; }

 private:
  std::shared_ptr<const Volume> source_;
  Tent tent_;
};

}  // namespace tidemark::solver
