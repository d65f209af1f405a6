// The speed by the nearer of two mean brightnesses around a voxel (Lankton and Tannenbaum, "Localizing
// Region-Based Active Contours", 2008). Private to the speed function `regions`.
#pragma once

#include <memory>

#include "solver/speed/block.h"
#include "solver/speed/cached_speed.h"
#include "solver/speed/inside_mask.h"
#include "solver/speed/speed_function.h"

namespace tidemark::solver {

// The means inside and outside of the surface are those of a box around the voxel.
class LocalRegionSpeed final : public SpeedFunction, public LocallyFollowing {
 public:
  // `reach`: voxels of the box on either side. `level`: a common brightness; sums of differences from it are
  // exact enough. D is 0 as long as there is no surface (`inside` is null).
  LocalRegionSpeed(std::shared_ptr<const Volume> source, Index3 reach, float level,
                   std::shared_ptr<const InsideMask> inside = nullptr, std::vector<bool> changed = {});

  void evaluate(const VoxelBox& box, double* speed) const override;
  [[nodiscard]] bool follows_surface() const override { return true; }
  [[nodiscard]] std::shared_ptr<const SpeedFunction> following(const Field& phi) const override;
  [[nodiscard]] bool is_as_before(const VoxelBox& box) const override;

 private:
  std::shared_ptr<const Volume> source_;
  Index3 reach_;
  double voxels_;  // in the box
  float level_;
  std::shared_ptr<const InsideMask> inside_;
  std::vector<bool> changed_;  // a page of `inside_`, since the function before; empty: there was none
};

}  // namespace tidemark::solver
