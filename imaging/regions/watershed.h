// Regions divided at their necks.
#pragma once

#include <cstddef>
#include <vector>

#include "core/progress.h"
#include "core/region.h"

namespace tidemark::imaging {

inline constexpr std::size_t kMostSeeds = 255;  // islands: there are no more labels

// The parts of a region, one for each island of `seeds`: those islands grow through the region, the voxels
// farthest from its border first, and meet where it is thin (Meyer's flooding of the distances to the
// border). Seeds may lie beside the region, too. Each part has its seed, in the order of Islands; voxels that
// no seed reaches are in none. Fails (ErrorKind::usage) with more than kMostSeeds seeds,
// (ErrorKind::cancelled).
Result<std::vector<Region>> watershed(const Region& region, const Region& seeds, const Geometry& grid,
                                      const Progress& progress = {});

}  // namespace tidemark::imaging
