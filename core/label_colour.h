// Colours of labels.
#pragma once

#include <array>
#include <cstdint>

namespace tidemark {

// Red, green and blue of a label until it gets others; `id` is 1 to 255, and no two have the same.
[[nodiscard]] std::array<std::uint8_t, 3> label_colour(std::uint8_t id);

}  // namespace tidemark
