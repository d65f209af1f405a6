#include "imaging/surface/phi_values.h"

#include <algorithm>

namespace tidemark::imaging {

void PhiValues::signs(std::int64_t j, std::int64_t k, std::uint8_t* row) const {
  const auto is_inside = [](float phi) { return std::uint8_t(phi > 0.0F); };
  const std::int64_t length = geometry_.size.x;
  if (dense_ != nullptr) {
    const float* const first = dense_ + geometry_.offset({0, j, k});
    std::transform(first, first + length, row, is_inside);
    return;
  }
  for (std::int64_t i = 0; i < length; i += kSide) {
    const std::int64_t there = std::min(kSide, length - i);
    const PhiPages::Page& at = page({i, j, k});
    if (at.values == nullptr) {
      std::fill_n(row + i, there, is_inside(at.constant));
    } else {
      const float* const first = at.values + index_in_page({i, j, k});
      std::transform(first, first + there, row + i, is_inside);
    }
  }
}

}  // namespace tidemark::imaging
