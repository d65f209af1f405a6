// The source on the plane of a slice picture, where it is too large to be a texture.
#pragma once

#include <glm/mat4x4.hpp>
#include <vector>

#include "core/volume.h"
#include "renderer/picture.h"

namespace tidemark::renderer {

// A value a pixel, rows from the bottom: between voxels, or with `nearest` that of the nearest one. From the
// view (x and y in -1..1) to voxel coordinates.
std::vector<float> source_on_plane(const Volume& source, const glm::dmat4& voxel_from_view, PictureSize size,
                                   bool nearest);

}  // namespace tidemark::renderer
