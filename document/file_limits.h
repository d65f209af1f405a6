// The most that files of documents may hold: more is damage, and no memory is taken for it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tidemark::document {

inline constexpr std::size_t kLongestName = 256;  // bytes
// Of a name that other files give, or that is joined of many names. In bytes.
inline constexpr std::size_t kLongestDescription = std::size_t{1} << 20;
inline constexpr std::size_t kMostImages = 64;
inline constexpr double kFarthest_mm = 1e11;  // coordinates of a map are as large
inline constexpr std::int64_t kMostSteps = 1'000'000'000;
// Far more than any machine loads. The memory that is taken is bounded by what a file holds.
inline constexpr std::int64_t kMostVoxels = std::int64_t{1} << 40;

}  // namespace tidemark::document
