// The inputs of commands that run a level set from a start: the volume, the truth, and all that the run does.
#pragma once

#include <optional>

#include "app/cli/results.h"
#include "app/cli/segment_options.h"
#include "core/bit_mask.h"

namespace tidemark::cli {

// Reads the study, smoothed as `options` say, fills in what --auto-start chooses, and makes the recipe: into
// the source, the figures and the recipe of `results`. Returns the mask of --truth, if it is given. Fails as
// the readers do, and (ErrorKind::cancelled).
Result<std::optional<BitMask>> read_inputs(SegmentOptions& options, bool wants_checksum, Console& console,
                                           RunResults& results);

}  // namespace tidemark::cli
