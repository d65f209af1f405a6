// A mask that is known to be right, to compare results with.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "core/bit_mask.h"
#include "core/progress.h"

namespace tidemark::document {

// From a volume file, or from a DICOM Segmentation or RT Structure Set, on that grid: the voxels that hold
// `label`, or the segment of that number (of a structure set the one at that place, from 1); without one all
// voxels that are not 0, or all segments. Fails (ErrorKind::input) as the readers do, (ErrorKind::usage)
// where there is no such segment.
Result<BitMask> load_truth(const std::filesystem::path& file, std::optional<std::int64_t> label,
                           const Geometry& grid, const Progress& progress = {});

}  // namespace tidemark::document
