// A finished picture.
#pragma once

#include <cstdint>
#include <vector>

namespace tidemark::renderer {

// 8 bits each of red, green, blue and opacity (255), rows from the top.
struct Picture {
  std::int64_t width = 0;
  std::int64_t height = 0;
  std::vector<std::uint8_t> pixels;
  double painted = 1.0;  // the share of them that was painted for it; others are the last picture's
};

struct PictureSize {
  std::int64_t width = 512;
  std::int64_t height = 512;

  bool operator==(const PictureSize&) const = default;
  [[nodiscard]] double aspect() const { return static_cast<double>(width) / static_cast<double>(height); }
};

}  // namespace tidemark::renderer
