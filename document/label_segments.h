// Labels as segments of result files, and back.
#pragma once

#include <span>
#include <vector>

#include "document/labels.h"
#include "imaging/results/segments.h"

namespace tidemark::document {

// A segment for each label, in their order, with name, colour and meaning; labels without voxels are empty
// segments. `voxels` holds a label id for each voxel of the grid, or nothing.
[[nodiscard]] imaging::Segments segments_of(const Geometry& geometry, std::span<const Label> labels,
                                            const PagedBytes& voxels);
[[nodiscard]] imaging::Segments segments_of(const Labels& labels);

// A new label for each segment, with its name, and its colour and meaning if it has them: one entry of the
// history. Where segments overlap the later one has the voxel; voxels of locked labels stay. Fails
// (ErrorKind::usage), adding nothing, when the grids differ or there would be more than 255 labels.
Status add_segments(Labels& labels, const imaging::Segments& segments);

}  // namespace tidemark::document
