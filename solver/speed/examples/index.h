// A place in an array, as arrays want it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tidemark::solver {

inline std::size_t at(std::int64_t index) {
  return static_cast<std::size_t>(index);
}

}  // namespace tidemark::solver
