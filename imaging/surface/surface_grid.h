// phi as an OpenVDB level set near its zero set. Private to this folder.
#pragma once

#include <openvdb/openvdb.h>

#include "imaging/surface/phi_values.h"

namespace tidemark::imaging {

// A grid in voxel coordinates that holds -phi (OpenVDB is negative inside) on the corners of every cell that
// the surface passes, and only there: memory follows the surface. The volume's border is extended by one
// layer of voxels outside, so that the surface is closed on the outer faces of the border voxels.
openvdb::FloatGrid::Ptr surface_grid(const PhiValues& phi);

}  // namespace tidemark::imaging
