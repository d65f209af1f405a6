// Strokes of examples as a brush changes them, and what panels and starts make of them.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/geometry.h"
#include "document/start.h"
#include "solver/speed/strokes.h"
#include "solver/sphere.h"

namespace tidemark::engine {

enum class Mark { none, inside, outside };

// `strokes` (null: none) after the voxels, ascending, became of one kind; Mark::none takes strokes away. Null
// when nothing is left.
std::shared_ptr<const solver::Strokes> painted(const solver::Strokes* strokes,
                                               const std::vector<std::int64_t>& voxels, Mark mark);

// Whether there are examples of both kinds, so that something can be learned.
[[nodiscard]] bool can_teach(const solver::Strokes* strokes);

// How many connected strokes the voxels, ascending, make.
[[nodiscard]] std::int64_t count_strokes(const Geometry& geometry, const std::vector<std::int64_t>& voxels);

// The voxel of each of these strokes that is nearest to its middle: what a click there would be.
[[nodiscard]] std::vector<Index3> middles_of_strokes(const Geometry& geometry,
                                                     const std::vector<std::int64_t>& voxels);

// Spheres of two voxels' radius along the voxels, ascending, from which a surface can begin.
std::vector<solver::Sphere> spheres_along(const Geometry& geometry, const std::vector<std::int64_t>& voxels);

// A start in all strokes inside.
document::Start start_in(const Geometry& geometry, const solver::Strokes& strokes);

}  // namespace tidemark::engine
