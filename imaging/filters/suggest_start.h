// A first start and parameters for a study, from its values alone.
#pragma once

#include <optional>

#include "core/progress.h"
#include "core/volume.h"

namespace tidemark::imaging {

// The values that a user would find with the mouse.
struct SuggestedStart {
  Index3 voxel{0};         // where to seed
  double radius_mm = 0.0;  // of the seed
  double target = 0.0;     // T and epsilon, in the volume's units
  double range = 0.0;
  double alpha = 0.6;
};

// What the user knows already: the seed's voxel, or the values among which it is sought (T, epsilon).
struct StartHints {
  std::optional<Index3> seed = {};
  std::optional<double> target = {};
  std::optional<double> range = {};
};

// T is the mean of the 5 x 5 x 5 voxels around the seed, epsilon the larger of two standard deviations there
// and 5 % of the span of values (1st to 99th percentile); in CT 30 HU. Without `seed` the voxel is chosen, in
// the central half of the volume along each axis: of the voxels brighter than Otsu's threshold (IEEE Trans.
// SMC 9:62, 1979) the one whose 5 x 5 x 5 neighbourhood varies least, the nearest to the centre among equals.
// In CT, of those with values of soft tissue (20 to 200 HU) the nearest to the centre whose neighbourhood
// varies by at most twice as much as the most even one's. That is some even tissue, not necessarily the
// wanted one. A volume without a modality counts as CT when a part of it has the values of air in Hounsfield
// units. With a target it is sought among values within half of the range of it (unknown: 5 % of the span)
// instead, as in CT. Fails (ErrorKind::input) when all values are equal, or the central half has none of
// those.
Result<SuggestedStart> suggest_start(const Volume& volume, const StartHints& hints = {},
                                     const Progress& progress = {});

}  // namespace tidemark::imaging
