// The agreement of two level sets of one grid.
#pragma once

#include <optional>
#include <utility>

#include "core/progress.h"
#include "core/region.h"
#include "solver/field.h"
#include "solver/point_tree.h"

namespace tidemark::solver {

// Between two surfaces, both ways: from each crossing of a grid line with one of them to the nearest crossing
// with the other.
struct SurfaceDistance {
  double mean_mm = 0.0;
  double most_mm = 0.0;     // the 95th percentile of all distances of both ways ("HD95")
  double largest_mm = 0.0;  // the Hausdorff distance
};

// A surface made ready for distances to others.
class MeasuredSurface {
 public:
  // Fails (ErrorKind::cancelled).
  static Result<MeasuredSurface> of(const Field& phi, const Progress& progress = {});
  // The surface half way between a region's voxels and the others of the grid: its points are the middles of
  // the faces between them. These are the crossings of the signed distance to the region's faces, too.
  static MeasuredSurface of(const Region& region, const Geometry& grid);

  [[nodiscard]] bool empty() const { return crossings_.points().empty(); }
  // Unset: one of them is empty. Their grids must be the same. Fails (ErrorKind::cancelled).
  [[nodiscard]] Result<std::optional<SurfaceDistance>> distance_to(const MeasuredSurface& other,
                                                                   const Progress& progress = {}) const;

 private:
  explicit MeasuredSurface(PointTree crossings) : crossings_(std::move(crossings)) {}
  PointTree crossings_;
};

struct SurfaceAgreement {
  double dice = 1.0;                        // 2 |A and B| / (|A| + |B|) of voxels inside; 1: both are empty
  std::optional<SurfaceDistance> distance;  // unset: one of them has no surface
};

// Their pages may differ in shape. Fails (ErrorKind::usage) when the grids differ, (ErrorKind::cancelled).
Result<SurfaceAgreement> agreement(const Field& a, const Field& b, const Progress& progress = {});

}  // namespace tidemark::solver
