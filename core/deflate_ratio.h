// The best ratio of deflate: what claims to hold more than so many bytes a packed one is damaged.
#pragma once

#include <cstdint>

namespace tidemark {

inline constexpr std::int64_t kBestDeflateRatio = 1032;

}  // namespace tidemark
