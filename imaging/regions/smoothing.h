// Smoothing of regions, in mm.
#pragma once

#include "core/progress.h"
#include "core/region.h"

namespace tidemark::imaging {

// The widest ball of a median, and the largest standard deviation, mm.
inline constexpr double kWidestSmoothing = 20.0;

// The voxels of which more than half of the ball around them is in the region: edges and corners are rounded,
// what is thinner than the ball goes. Beyond the grid its outermost voxels go on. Fails (ErrorKind::usage)
// for a radius that is not in (0, kWidestSmoothing] mm, or a ball of more than 65,535 voxels;
// (ErrorKind::cancelled).
Result<Region> smoothed_by_median(const Region& region, const Geometry& grid, double radius_mm,
                                  const Progress& progress = {});

// The region after a Gaussian of that standard deviation, at the level that keeps its volume as nearly as
// levels of 1/65,535 allow. It takes memory for the floats of 6 sigma of slices, on any number of threads.
// Fails (ErrorKind::usage) for a sigma that is not in (0, kWidestSmoothing] mm; (ErrorKind::cancelled).
Result<Region> smoothed_by_gaussian(const Region& region, const Geometry& grid, double sigma_mm,
                                    const Progress& progress = {});

}  // namespace tidemark::imaging
