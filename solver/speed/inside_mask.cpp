#include "solver/speed/inside_mask.h"

#include <algorithm>
#include <bit>
#include <glm/common.hpp>

#include "solver/paging/page_rows.h"

namespace tidemark::solver {

InsideMask::InsideMask(const Field& phi)
    : layout_(phi.layout), words_per_page_((phi.layout.voxels_per_page() + 63) / 64), table_(phi.table) {
  words_.resize(static_cast<std::size_t>(phi.resident_pages() * words_per_page_));
  for (std::int64_t page = 0; page < layout_.page_count(); ++page) {
    const std::int32_t entry = table_[static_cast<std::size_t>(page)];
    if (entry < 0) continue;
    const float* values = phi.pages.data() + entry * layout_.voxels_per_page();
    std::uint64_t* words = words_.data() + entry * words_per_page_;
    for_each_row(phi.geometry, layout_, page, [&](std::int64_t, std::int64_t length, std::int64_t index) {
      for (std::int64_t i = index; i < index + length; ++i) {
        if (values[i] > 0.0F) words[i / 64] |= std::uint64_t{1} << (i % 64);
      }
    });
  }
}

std::uint64_t InsideMask::word(std::int64_t page, std::int64_t i) const {
  const std::int32_t entry = table_[static_cast<std::size_t>(page)];
  if (entry == Field::kOutside) return 0;
  if (entry == Field::kInside) return ~std::uint64_t{0};
  return words_[static_cast<std::size_t>(entry * words_per_page_ + i)];
}

Block InsideMask::values_in(const VoxelBox& box) const {
  Block block{box, std::vector<float>(static_cast<std::size_t>(box.voxels()))};
  const Index3 last = layout_.volume_size() - Index3(1);
  const Index3 shape = layout_.page_shape();
  const std::int64_t end_x = box.first.x + box.size.x;
  float* value = block.values.data();
  for (std::int64_t z = box.first.z; z < box.first.z + box.size.z; ++z) {
    for (std::int64_t y = box.first.y; y < box.first.y + box.size.y; ++y) {
      const Index3 row = glm::clamp(Index3(0, y, z), Index3(0), last);
      const std::int64_t in_page = shape.x * (row.y % shape.y + shape.y * (row.z % shape.z));
      const std::int64_t first_page = layout_.page_number({0, row.y / shape.y, row.z / shape.z});
      // From page to page; the first one and the last one go on beyond the grid.
      for (std::int64_t x = box.first.x; x < end_x;) {
        const std::int64_t page_x = std::clamp<std::int64_t>(x, 0, last.x) / shape.x;
        const std::int64_t page_end = (page_x + 1) * shape.x;
        const std::int64_t end = page_end > last.x ? end_x : std::min(page_end, end_x);
        const std::int32_t entry = table_[static_cast<std::size_t>(first_page + page_x)];
        if (entry < 0) {
          value = std::fill_n(value, end - x, entry == Field::kInside ? 1.0F : 0.0F);
          x = end;
          continue;
        }
        const std::uint64_t* words = words_.data() + entry * words_per_page_;
        for (; x < end; ++x) {
          const std::int64_t i = in_page + std::clamp<std::int64_t>(x, 0, last.x) - page_x * shape.x;
          *value++ = static_cast<float>(words[i / 64] >> (i % 64) & 1);
        }
      }
    }
  }
  return block;
}

std::int64_t InsideMask::largest_change(const InsideMask& other) const {
  if (layout_ != other.layout_) return layout_.voxels_per_page();
  std::int64_t largest = 0;
  for (std::int64_t page = 0; page < layout_.page_count(); ++page) {
    const auto at = static_cast<std::size_t>(page);
    if (table_[at] < 0 && table_[at] == other.table_[at]) continue;
    std::int64_t changed = 0;
    for (std::int64_t i = 0; i < words_per_page_; ++i)
      changed += std::popcount(word(page, i) ^ other.word(page, i));
    largest = std::max(largest, changed);
  }
  return largest;
}

}  // namespace tidemark::solver
