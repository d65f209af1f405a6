// The filters that prepare a start: smoothing of the source, masks from values.
#pragma once

#include "core/bit_mask.h"
#include "core/inside.h"
#include "core/progress.h"
#include "core/volume.h"

namespace tidemark::imaging {

// What recipes, lessons and lists of cases can hold.
inline constexpr double kMostSmoothing_mm = 1000.0;

// Gaussian smoothing with standard deviation sigma_mm > 0 along every axis; the result is a float volume on
// the same grid (ITK's recursive Gaussian).
Result<Volume> smooth(const Volume& volume, double sigma_mm, const Progress& progress = {});

// Voxels with low <= value <= high. The volume must outlive the first.
Inside between(const Volume& volume, double low, double high);
Mask threshold(const Volume& volume, double low, double high);

// The voxels with low <= value <= high that are connected to `seed` across faces (ITK's ConnectedThreshold).
// Fails (ErrorKind::usage) when the seed is outside the volume or its value is outside [low, high].
Result<BitMask> flood_fill(const Volume& volume, Index3 seed, double low, double high);

}  // namespace tidemark::imaging
