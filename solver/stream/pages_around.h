// A walk over the pages around a page.
#pragma once

#include "core/index_walk.h"

namespace tidemark::solver {

// Calls visit(coordinates) for a page and those around it, `reach` pages far along each axis, until it
// returns false.
template <class Visit>
bool all_within(Index3 reach, Index3 page, Visit visit) {
  return all_indices(page - reach, page + reach + Index3(1), visit);
}

}  // namespace tidemark::solver
