// Maps of distances that colour the surface in the views of a case.
#pragma once

#include <memory>

#include "core/bit_mask.h"
#include "document/agreement.h"
#include "solver/speed/speed_function.h"

namespace tidemark::engine {

// Which of them is shown in place of how far the surface has moved.
enum class SurfaceMap { none, truth_error, spread };

// From which distance on colours do not change any more, mm: three of the largest spacing, in whole mm.
[[nodiscard]] double distance_range_mm(const Geometry& geometry);

// How far voxels are from a known answer's surface: -1 inside to 1 outside, at that range.
[[nodiscard]] std::shared_ptr<const solver::SpeedFunction> truth_error_map(const BitMask& truth);

// How far apart the surfaces of several runs are there, from the innermost to the outermost: -1 where they
// are one, 1 from that range on. It grows, too, away from all of them. Surfaces that have vanished do not
// count, and not all have. `grid` is that of the runs.
[[nodiscard]] std::shared_ptr<const solver::SpeedFunction> spread_map(const document::Agreement& runs,
                                                                      const Geometry& grid);

}  // namespace tidemark::engine
