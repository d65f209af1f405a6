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
    const std::int32_t entry = paged_.table[static_cast<std::size_t>(page_number(page_of({i, j, k})))];
    if (entry < 0) {
      std::fill_n(row + i, there, is_inside(paged_.constant(entry)));
    } else {
      const float* const first = page(entry) + index_in_page({i, j, k});
      std::transform(first, first + there, row + i, is_inside);
    }
  }
}

}  // namespace tidemark::imaging
