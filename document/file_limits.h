// The most that files of documents may hold: more is damage, and no memory is taken for it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tidemark::document {

inline constexpr std::size_t kLongestName = 256;  // bytes
inline constexpr std::size_t kMostImages = 64;
inline constexpr std::int64_t kMostSteps = 1'000'000'000;
inline constexpr std::int64_t kMostVoxels = std::int64_t{1} << 31;

}  // namespace tidemark::document
