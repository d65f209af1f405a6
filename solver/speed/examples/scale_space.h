// A Gaussian pyramid: a volume's local mean and mean square at growing scales, on grids that grow coarser.
#pragma once

#include <memory>
#include <vector>

#include "core/progress.h"
#include "core/volume.h"
#include "solver/speed/block.h"

namespace tidemark::solver {

// The scales of the pyramid and the one below it, as multiples of the smallest spacing: in mm they are the
// same along all axes.
inline constexpr double kFinestScale = 0.7;
inline constexpr double kPyramidScales[] = {1.6, 3.2, 6.4, 12.8};

// Numbers in two bytes each, in steps that are even over their range.
class EvenSteps {
 public:
  EvenSteps() = default;
  // What is beyond low and high becomes them.
  EvenSteps(const std::vector<float>& values, float low, float high);

  [[nodiscard]] float operator[](std::size_t i) const { return low_ + step_ * static_cast<float>(steps_[i]); }
  [[nodiscard]] std::int64_t memory() const {  // bytes
    return static_cast<std::int64_t>(steps_.size() * sizeof(std::uint16_t));
  }

 private:
  float low_ = 0.0F;
  float step_ = 0.0F;
  std::vector<std::uint16_t> steps_;
};

// Node n lies at voxel n * step.
struct ScaleGrid {
  Index3 size{1};
  Index3 step{1};
  glm::dvec3 step_mm{1.0};
  // Of the values less the pyramid's centre, in voxel order.
  EvenSteps mean;
  EvenSteps deviation;

  [[nodiscard]] float square(std::size_t node) const {
    return deviation[node] * deviation[node] + mean[node] * mean[node];
  }
};

// Local moments in a box of nodes, which may reach beyond the grid.
struct Moments {
  VoxelBox box;
  std::vector<float> mean;
  std::vector<float> square;
};

// Takes 0.6 bytes a voxel of an isotropic volume, 1.4 of one whose slices are thick.
class ScaleSpace {
 public:
  // The pyramid of a volume, shared among all that use it at the same time. Fails (ErrorKind::cancelled).
  static Result<std::shared_ptr<const ScaleSpace>> of(const std::shared_ptr<const Volume>& volume,
                                                      const Progress& progress);

  // One a scale, the first of them computed from the volume, not kept: its grid is the volume's.
  [[nodiscard]] int scales() const { return 1 + static_cast<int>(grids_.size()); }
  [[nodiscard]] Index3 step(int scale) const;
  [[nodiscard]] Index3 size(int scale) const;
  [[nodiscard]] glm::dvec3 step_mm(int scale) const;
  // `volume` is the one that it was made of.
  [[nodiscard]] Moments moments(const Volume& volume, int scale, const VoxelBox& nodes) const;
  [[nodiscard]] std::int64_t memory() const;  // bytes

 private:
  static Result<std::shared_ptr<const ScaleSpace>> make(const Volume& volume, const Progress& progress);

  Geometry geometry_;
  float centre_ = 0.0F;  // keeps squares small: they are subtracted from each other
  AxisWeights finest_;
  std::vector<ScaleGrid> grids_;
};

}  // namespace tidemark::solver
