// The best that one brightness and one range reach on a study, found with its truth at hand.
#pragma once

#include <memory>

#include "core/result.h"
#include "core/volume.h"

namespace tidemark {

// Dice of the level set that begins with a sphere at the voxel. T and epsilon are those of three intervals
// of values: of all whose ends are quantiles of the object's values they find the most by a plain threshold.
Result<double> best_tent(const std::shared_ptr<const Volume>& source, const Mask& truth, Index3 seed,
                         double alpha, std::int64_t steps);

}  // namespace tidemark
