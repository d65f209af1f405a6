// The exact distance transform that makes a level set of a mask; smoothing a step would move the surface.
#pragma once

#include "core/inside.h"
#include "core/volume.h"
#include "solver/field.h"

namespace tidemark::solver {

// The clamped signed distance, in units of the smallest spacing, from voxel centres to the mask's boundary,
// which is made of the faces between voxels inside and outside: next to a flat face phi is half a voxel.
// Exact inside the band, for any spacing. > 0 inside. band = W must be finite. Beside the result it takes
// memory for a layer of pages, and computes only where the boundary is as near as the band reaches.
Field distance_transform(const Inside& inside, double band, Index3 page_shape = kDefaultPageShape);
Field distance_transform(const Mask& mask, double band, Index3 page_shape = kDefaultPageShape);

}  // namespace tidemark::solver
