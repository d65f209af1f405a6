// Speed functions: D a voxel and, for some, an advection velocity (paper eq. 1, section 7).
#pragma once

#include <memory>

#include <glm/vec3.hpp>

#include "core/volume.h"
#include "solver/field.h"

namespace tidemark::solver {

// D = max(floor, peak - slope |I - T|): eq. 7 in numbers that a GPU evaluates itself.
struct Tent {
  double target = 0.0;  // T, in the source's units
  double peak = 1.0;
  double slope = 1.0;  // per unit of the source
  double floor = -1.0;

  // Whether D may be beyond [-1, 1]: the raw form.
  [[nodiscard]] bool is_raw() const { return floor < -1.0; }
  bool operator==(const Tent&) const = default;
};

// A box of voxels: `first` and those that follow it, x fastest.
struct VoxelBox {
  Index3 first{0};
  Index3 size{1};

  [[nodiscard]] std::int64_t voxels() const { return size.x * size.y * size.z; }
};

// The voxels that are in both.
inline VoxelBox common(const VoxelBox& a, const VoxelBox& b) {
  const Index3 first = glm::max(a.first, b.first);
  return {first, glm::max(glm::min(a.first + a.size, b.first + b.size) - first, Index3(0))};
}

// An immutable function of the voxel. All of its methods may be called from several threads at once, and give
// the same bits for a voxel whichever box it is asked for in.
class SpeedFunction {
 public:
  virtual ~SpeedFunction() = default;

  // Writes D of the box's voxels. The box lies inside of the grid. D is in [-1, 1], but for the raw tent's.
  virtual void evaluate(const VoxelBox& box, double* speed) const = 0;
  // The same for who asks for a voxel once alone: no cache keeps it.
  virtual void evaluate_once(const VoxelBox& box, double* speed) const { evaluate(box, speed); }
  // max |D|, which bounds the time step.
  [[nodiscard]] virtual double largest() const { return 1.0; }

  // The tent that it is, if it is one of the level set's source.
  [[nodiscard]] virtual const Tent* tent() const { return nullptr; }

  // Whether there is a velocity v beside D: dphi/dt has the term -v . grad phi then.
  [[nodiscard]] virtual bool advects() const { return false; }
  // Writes v of the box's voxels, along the axes of the grid, in units of the smallest spacing per unit of
  // time; it is no faster than fastest_advection().
  virtual void evaluate_advection(const VoxelBox& /*box*/, glm::vec3* /*velocity*/) const {}
  [[nodiscard]] virtual double fastest_advection() const { return 0.0; }

  // Whether D comes from a probability p that was learned. Its doubt is the entropy of p in bits, 0 to 1.
  [[nodiscard]] virtual bool has_doubt() const { return false; }
  // Writes the doubt of the box's voxels.
  virtual void evaluate_doubt(const VoxelBox& /*box*/, double* /*doubt*/) const {}

  // Whether D depends on the surface. An executor then asks for the function that belongs to its phi before
  // its first step and at the end of each window of kConvergenceWindow steps.
  [[nodiscard]] virtual bool follows_surface() const { return false; }
  // Null: this one still fits.
  [[nodiscard]] virtual std::shared_ptr<const SpeedFunction> following(const Field& /*phi*/) const {
    return nullptr;
  }
};

}  // namespace tidemark::solver
