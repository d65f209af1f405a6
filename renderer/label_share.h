// The borders of labels between voxels, smoothed.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/paging/page_layout.h"

namespace tidemark::renderer {

// For each voxel, in voxel order, how much of what is around it has its own label: the weight in a Gaussian
// of 1.1 voxels over 5 voxels an axis, 255 for all of it. Never less than a little above a half, so that
// where shares are equal between two voxels is never beyond the middle of either: what is one voxel thick
// stays. Only pages that `mixed` names are looked at; the other voxels have 255.
std::vector<std::uint8_t> label_shares(const solver::PageLayout& layout, std::span<const std::uint8_t> labels,
                                       const std::vector<std::int64_t>& mixed);

}  // namespace tidemark::renderer
