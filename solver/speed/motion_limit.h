// The limit of a surface's motion: it stays within so many mm of a mask's surface, to both sides.
#pragma once

#include <memory>
#include <mutex>
#include <utility>

#include "core/bit_mask.h"
#include "solver/field.h"
#include "solver/speed/constraints.h"
#include "solver/speed/speed_function.h"

namespace tidemark::solver {

// Distances are those of distance_transform(): from the faces between voxels inside and outside of the mask.
// phi <= d + n and phi >= d - n, where d > 0 is the distance inside and n the limit: the surface stops
// between voxels where the distance is n, or at most 1 / kLimitSteps of the smallest spacing before. Across
// slices that are more than kLimitReach of it apart, it stops between the last slice within the limit and the
// next one.
class MotionLimit {
 public:
  // `within_mm` > 0. What follows from it is made when somebody first asks: a start that is only read costs
  // nothing. All methods may be called from several threads at once.
  MotionLimit(std::shared_ptr<const BitMask> mask, double within_mm)
      : mask_(std::move(mask)), within_mm_(within_mm) {}

  [[nodiscard]] double within_mm() const { return within_mm_; }
  // What holds the surface in an executor.
  [[nodiscard]] const std::shared_ptr<const Constraints>& constraints() const { return made().constraints; }
  // As a map for views: how far outside of the mask's surface a voxel lies, over the limit, from -1 to 1.
  // Where a surface is, that is how far it has moved.
  [[nodiscard]] const std::shared_ptr<const SpeedFunction>& change() const { return made().change; }

 private:
  struct Made {
    std::shared_ptr<const Constraints> constraints;
    std::shared_ptr<const SpeedFunction> change;
  };
  [[nodiscard]] const Made& made() const;

  std::shared_ptr<const BitMask> mask_;
  double within_mm_;
  mutable std::once_flag once_;
  mutable Made made_;
};

}  // namespace tidemark::solver
