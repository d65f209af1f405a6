// The values of a voxel that `examples` learns from: features of all scales of all images, and its place.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "solver/speed/examples/node_features.h"
#include "solver/speed/examples/scale_space.h"

namespace tidemark::solver {

// The voxels at all combinations of places along the axes, each of which ascends.
using VoxelLattice = std::array<std::vector<std::int64_t>, 3>;

// Features of voxels, for boxes; thread-safe. A voxel's have the same bits in every box.
class Features {
 public:
  // Volumes on one grid, at least one. Fails (ErrorKind::cancelled), and (ErrorKind::usage) when an image has
  // another size than the first.
  static Result<Features> of(std::vector<std::shared_ptr<const Volume>> volumes, const Progress& progress);

  [[nodiscard]] int count() const;
  [[nodiscard]] const Geometry& geometry() const { return volumes_.front()->geometry; }
  // Writes count() arrays of box.voxels() numbers. The box is small: a few thousand voxels.
  void evaluate(const VoxelBox& box, float* features) const;
  // The same for voxels that are a few apart.
  void evaluate(const VoxelLattice& lattice, float* features) const;
  [[nodiscard]] std::int64_t memory() const;  // bytes

 private:
  std::vector<std::shared_ptr<const Volume>> volumes_;
  std::vector<std::shared_ptr<const ScaleSpace>> spaces_;  // of each
};

}  // namespace tidemark::solver
