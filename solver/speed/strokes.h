// Strokes: voxels that a user marked as inside or outside of what is to be found.
#pragma once

#include <cstdint>
#include <vector>

#include "core/volume.h"

namespace tidemark::solver {

// Offsets in the grid (Geometry::offset), ascending, each in one of the lists at most.
struct Strokes {
  std::vector<std::int64_t> inside;
  std::vector<std::int64_t> outside;

  [[nodiscard]] bool empty() const { return inside.empty() && outside.empty(); }
  bool operator==(const Strokes&) const = default;
};

}  // namespace tidemark::solver
