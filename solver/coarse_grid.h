// Coarser grids over a volume, for a level set that runs on them first.
#pragma once

#include <memory>

#include "core/inside.h"
#include "core/volume.h"
#include "solver/field.h"
#include "solver/parameters.h"
#include "solver/speed/constraints.h"

namespace tidemark::solver {

// A grid of blocks of 1, 2 or 4 voxels along each axis. A level halves the axes whose spacing is at most
// kLikeSpacing times the smallest: thick slices stay until the pixels are as large. Blocks at the end of an
// axis may be incomplete.
class CoarseGrid {
 public:
  static constexpr double kLikeSpacing = 1.5;
  static constexpr int kMostLevels = 3;

  // `halvings`: 0 to kMostLevels - 1.
  CoarseGrid(const Geometry& fine, int halvings);

  [[nodiscard]] const Geometry& fine() const { return fine_; }
  [[nodiscard]] const Geometry& coarse() const { return coarse_; }
  [[nodiscard]] Index3 factor() const { return factor_; }
  // The smallest spacing by that of the fine grid: what phi's unit has become.
  [[nodiscard]] double scale() const { return scale_; }
  // The voxels of a block: all of them are on the fine grid.
  [[nodiscard]] Index3 first_of(Index3 block) const { return block * factor_; }
  [[nodiscard]] Index3 size_of(Index3 block) const;

 private:
  Geometry fine_;
  Geometry coarse_;
  Index3 factor_{1};
  double scale_ = 1.0;
};

// As many levels as bring a volume to about two million voxels: 1 to CoarseGrid::kMostLevels.
[[nodiscard]] int levels_for(const Geometry& geometry);

// A block is inside where at least half of its voxels are.
[[nodiscard]] Mask coarsened(const Inside& inside, const CoarseGrid& grid);
// A block is a wall where one of its voxels is, else an anchor where all of them are. Limits of phi, which
// lie between voxels, are left out.
[[nodiscard]] Constraints coarsened(const Constraints& constraints, const CoarseGrid& grid);
// Balances data and curvature on the coarse grid as on the fine one: lengths there are in units of its own
// spacing, so that alpha becomes s alpha / (s alpha + 1 - alpha), s the scale.
[[nodiscard]] Parameters coarsened(const Parameters& parameters, const CoarseGrid& grid);
// What a velocity is multiplied by on the coarse grid, to keep its balance with data and curvature: they have
// alpha' and s (1 - alpha') there, both s / (s alpha + 1 - alpha) times what they have on the fine one.
[[nodiscard]] double velocity_factor(const Parameters& parameters, const CoarseGrid& grid);

// phi of the coarse grid on the fine one, between voxels by linear interpolation, clamped to `band`.
// `threads` as of ThreadPool.
[[nodiscard]] Field refined(const Field& phi, const CoarseGrid& grid, double band, Index3 page_shape,
                            int threads = 0);

}  // namespace tidemark::solver
