// Labels as segments of result files, and back.
#pragma once

#include "imaging/results/segments.h"
#include "study/labels.h"

namespace tidemark {

// A segment for each label, in their order, with name and colour; labels without voxels are empty segments.
[[nodiscard]] Segments segments_of(const Labels& labels);

// A new label for each segment, with its name and its colour if it has one. Where segments overlap the later
// one has the voxel; voxels of locked labels stay. Fails (ErrorKind::usage) when the grids differ or there
// would be more than 255 labels; then no label was added.
Status add_segments(Labels& labels, const Segments& segments);

}  // namespace tidemark
