// A user who paints where the surface is wrong.
#pragma once

#include <vector>

#include "core/volume.h"
#include "solver/speed/strokes.h"

namespace tidemark {

class Robot {
 public:
  explicit Robot(const Mask& truth);

  // Two strokes inside: at the deepest point, and at the deepest far from it. Three outside, just beyond
  // the border.
  void begin();
  // A stroke at the deepest point of the largest miss, and one at that of the largest leak.
  void correct(const Mask& found);

  [[nodiscard]] const solver::Strokes& strokes() const { return strokes_; }
  [[nodiscard]] int count() const { return count_; }  // of strokes
  // Where strokes inside were painted.
  [[nodiscard]] const std::vector<Index3>& inside() const { return inside_; }

 private:
  // A disc in a slice, as far as it is right.
  void paint(Index3 centre, bool inside);
  void paint_deepest(Mask wrong, bool inside);
  [[nodiscard]] bool is_inside(Index3 voxel) const;

  const Mask& truth_;
  std::vector<std::uint8_t> painted_;
  solver::Strokes strokes_;
  std::vector<Index3> inside_;
  int count_ = 0;
};

// The parts of D > 0 that are connected to the voxels, across faces.
Mask connected(const Geometry& grid, const std::vector<double>& speed, const std::vector<Index3>& from);

}  // namespace tidemark
