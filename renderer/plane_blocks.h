// The blocks of a volume that a plane crosses.
#pragma once

#include <glm/mat4x4.hpp>
#include <vector>

#include "core/paging/page_layout.h"

namespace tidemark::renderer {

// The first voxels of the blocks that a slice reads, by linear interpolation between voxels.
// `voxel_from_view`: from the view's square, -1 to 1 along x and y, to voxel coordinates.
std::vector<Index3> blocks_on_plane(const PageLayout& blocks, const glm::dmat4& voxel_from_view);

}  // namespace tidemark::renderer
