// A volume on another grid in the patient: how further images of a case come onto the grid of its own.
#pragma once

#include <glm/mat4x4.hpp>
#include <optional>
#include <string>

#include "core/progress.h"
#include "core/region.h"
#include "core/volume.h"

namespace tidemark::imaging {

struct Resampled {
  Volume volume;   // float, on the grid
  Region covered;  // the grid's voxels that are in the image, one at least
};

// The image on the grid, trilinearly. Voxels outside of the image have its minimum, or `outside`. `transform`
// leads from the image's patient coordinates (LPS, mm) to the grid's and must be invertible. An image reaches
// half a voxel beyond the centres of its outermost voxels. Fails (ErrorKind::usage), naming `what` (the
// image) and both grids, when no voxel of the grid is in the image.
Result<Resampled> resample(const Volume& image, const glm::dmat4& transform, const Geometry& grid,
                           const std::string& what, const Progress& progress = {},
                           std::optional<float> outside = {});

// The image's value at a place of its own patient coordinates, trilinearly; nothing outside of it.
[[nodiscard]] std::optional<double> value_at(const Volume& image, glm::dvec3 patient_mm);

}  // namespace tidemark::imaging
