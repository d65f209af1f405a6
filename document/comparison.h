// The comparison of two regions of one grid: how much they share, and how far apart their surfaces are.
#pragma once

#include <optional>

#include "core/region.h"
#include "solver/surface_agreement.h"

namespace tidemark::document {

struct Comparison {
  std::int64_t voxels = 0;                          // of the first
  std::int64_t other_voxels = 0;                    // of the second
  std::int64_t common = 0;                          // of both
  double voxel_ml = 0.0;                            // the volume of a voxel
  std::optional<solver::SurfaceDistance> distance;  // unset: one of them has no surface

  // 2 |A and B| / (|A| + |B|), and |A and B| / |A or B|; 1 when both are empty.
  [[nodiscard]] double dice() const;
  [[nodiscard]] double jaccard() const;
};

// Fails (ErrorKind::cancelled).
Result<Comparison> compare(const Region& region, const Region& other, const Geometry& grid,
                           const Progress& progress = {});

}  // namespace tidemark::document
