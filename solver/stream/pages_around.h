// A walk over the pages around a page.
#pragma once

#include "core/geometry.h"

namespace tidemark::solver {

// Calls visit(coordinates) for a page and those around it, `reach` pages far along each axis, until it
// returns false.
template <class Visit>
bool all_within(Index3 reach, Index3 page, Visit visit) {
  for (std::int64_t z = -reach.z; z <= reach.z; ++z) {
    for (std::int64_t y = -reach.y; y <= reach.y; ++y) {
      for (std::int64_t x = -reach.x; x <= reach.x; ++x) {
        if (!visit(page + Index3(x, y, z))) return false;
      }
    }
  }
  return true;
}

}  // namespace tidemark::solver
