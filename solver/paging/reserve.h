// The reserve of pages in the memory G of a graphics executor.
#pragma once

#include <algorithm>
#include <cstdint>

namespace tidemark::solver {

// Beyond the pages that are needed when G grows: an eighth, so that little of it lies idle.
inline std::int64_t reserve_of(std::int64_t pages, std::int64_t at_least) {
  return std::max(pages / 8, at_least);
}

}  // namespace tidemark::solver
