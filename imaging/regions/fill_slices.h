// The filling of slices between those that were drawn.
#pragma once

#include "core/progress.h"
#include "core/region.h"

namespace tidemark::imaging {

// The region with its empty slices between others filled, along an axis (0, 1, 2) of the grid: by the signed
// distances to the outlines in the slices before and behind, each by how near it is (Raya and Udupa, IEEE
// Trans. Med. Imaging 9:32, 1990). Slices that hold voxels stay as they are. Where outlines do not overlap
// there may be nothing half way. Fails (ErrorKind::usage) when no slice lies between others,
// (ErrorKind::cancelled).
Result<Region> with_slices_filled(const Region& region, const Geometry& grid, int axis,
                                  const Progress& progress = {});

}  // namespace tidemark::imaging
