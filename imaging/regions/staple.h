// The estimate of a truth from what several readers drew.
#pragma once

#include <vector>

#include "core/progress.h"
#include "core/region.h"

namespace tidemark::imaging {

struct ReaderQuality {
  double sensitivity = 0.0;  // the share of the estimate's voxels that the reader has
  double specificity = 0.0;  // the share of the other voxels that the reader has not
  double dice = 0.0;         // of the reader and the estimate
};

struct TruthEstimate {
  Region region;                       // where it is more likely than not
  std::vector<ReaderQuality> readers;  // in their order
};

// STAPLE (Warfield, Zou and Wells, IEEE Trans. Med. Imaging 23:903, 2004; ITK's), in the box around all
// regions and a tenth of it, at least a voxel, beside it: what is far from all readers would make each of
// them specific. Fails (ErrorKind::usage) with fewer than two regions, or when all are empty;
// (ErrorKind::cancelled).
Result<TruthEstimate> estimate_truth(const std::vector<Region>& readers, const Geometry& grid,
                                     const Progress& progress = {});

}  // namespace tidemark::imaging
