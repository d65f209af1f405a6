// The fit of a mesh's vertices to the zero set of phi between the voxels. Private to this folder.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "imaging/surface/phi_values.h"

namespace tidemark::imaging {

// Dual vertices are means of points on their cell's edges and lie inside every bulge; the flat triangles
// between them do so once more. On a ball of radius 10 voxels the two take 1.1 % of its volume, with slices
// four times as thick 4.4 %. Here phi is interpolated to second order, each vertex moves along the
// gradient to phi = 0, and then outward or inward until phi is 0 on average over the triangles around it. A
// vertex never leaves the cell that it is in; those outside the border voxels' centres (the caps) stay as
// they are. `vertices` are voxel coordinates; `phi` is in units of the smallest spacing.
void fit_vertices(const PhiValues& phi, const std::vector<std::array<std::uint32_t, 3>>& triangles,
                  std::vector<glm::dvec3>& vertices);

}  // namespace tidemark::imaging
