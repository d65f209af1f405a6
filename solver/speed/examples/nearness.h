// A voxel's nearness to strokes inside against that to strokes outside.
#pragma once

#include <vector>

#include "solver/speed/speed_function.h"
#include "solver/speed/strokes.h"

namespace tidemark::solver {

// Thread-safe. A voxel's has the same bits in every box.
class Nearness {
 public:
  // Of strokes of both kinds.
  Nearness(const Strokes& strokes, const Geometry& geometry);
  // Of each voxel of the box, x fastest: 1 in a stroke inside, -1 in one outside, 0 halfway between both.
  void evaluate(const VoxelBox& box, float* nearness) const;

 private:
  glm::vec3 spacing_mm_;
  std::vector<glm::vec3> inside_;  // mm, along the grid's axes
  std::vector<glm::vec3> outside_;
};

}  // namespace tidemark::solver
