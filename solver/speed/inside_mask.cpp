#include "solver/speed/inside_mask.h"

#include <algorithm>
#include <bit>
#include <glm/common.hpp>

#include "core/index_walk.h"

namespace tidemark::solver {
namespace {

constexpr std::int64_t kSide = kDefaultPageShape.x;

// Whether the pages of phi that hold the box are all inside or all outside; `side` is which.
bool is_constant(const Field& phi, const VoxelBox& box, Field::Kind& side) {
  const auto kind = [&](Index3 page) { return phi.pages.kind(phi.layout.page_number(page)); };
  side = kind(box.first / phi.layout.page_shape());
  return side != Field::Kind::stored && all_pages(phi.layout, box.first, box.first + box.size,
                                                  [&](Index3 page) { return kind(page) == side; });
}

// Bit i: the i-th of a row's voxels is inside. The row lies in one page of 8^3.
std::uint64_t inside_of_row(const Field& phi, Index3 first, std::int64_t length) {
  const std::int64_t page_length = phi.layout.page_shape().x;
  std::uint64_t inside = 0;
  for (std::int64_t x = 0; x < length;) {
    const Index3 voxel = first + Index3(x, 0, 0);
    const VirtualAddress address = phi.layout.translate(voxel);
    const std::int64_t end = std::min(length, x + page_length - voxel.x % page_length);
    const float* value = phi.pages.values(address.page);
    if (value == nullptr) {
      const std::uint64_t all = (std::uint64_t{1} << (end - x)) - 1;
      if (phi.pages.kind(address.page) == Field::Kind::inside) inside |= all << x;
      x = end;
      continue;
    }
    value += address.offset;
    for (; x < end; ++x) inside |= std::uint64_t(*value++ > 0.0F) << x;
  }
  return inside;
}

}  // namespace

InsideMask::Bits InsideMask::inside_of(const Field& phi, const VoxelBox& box) {
  Bits inside{};
  for (std::int64_t z = 0; z < box.size.z; ++z) {
    for (std::int64_t y = 0; y < box.size.y; ++y) {
      inside[static_cast<std::size_t>(z)] |= inside_of_row(phi, box.first + Index3(0, y, z), box.size.x)
                                             << (kSide * y);
    }
  }
  return inside;
}

InsideMask::InsideMask(const Field& phi)
    : layout_(phi.geometry.size, kDefaultPageShape), table_(static_cast<std::size_t>(layout_.page_count())) {
  for (std::int64_t page = 0; page < layout_.page_count(); ++page) {
    std::int32_t& entry = table_[static_cast<std::size_t>(page)];
    const VoxelBox box{layout_.first_voxel(page), layout_.valid_shape(page)};
    Field::Kind side{};
    if (is_constant(phi, box, side)) {
      entry = side == Field::Kind::inside ? kAllInside : kAllOutside;
      continue;
    }
    const Bits inside = inside_of(phi, box);
    std::int64_t count = 0;
    for (const std::uint64_t slice : inside) count += std::popcount(slice);
    if (count == 0 || count == box.voxels()) {
      entry = count == 0 ? kAllOutside : kAllInside;
    } else {
      entry = static_cast<std::int32_t>(pages_.size());
      pages_.push_back(inside);
    }
  }
}

Block InsideMask::values_in(const VoxelBox& box) const {
  Block block{box, std::vector<float>(static_cast<std::size_t>(box.voxels()))};
  const Index3 last = layout_.domain_size() - Index3(1);
  const std::int64_t end_x = box.first.x + box.size.x;
  float* value = block.values.data();
  for (std::int64_t z = box.first.z; z < box.first.z + box.size.z; ++z) {
    for (std::int64_t y = box.first.y; y < box.first.y + box.size.y; ++y) {
      const Index3 row = glm::clamp(Index3(0, y, z), Index3(0), last);
      const std::int64_t first_page = layout_.page_number({0, row.y / kSide, row.z / kSide});
      // From page to page; the first one and the last one go on beyond the grid.
      for (std::int64_t x = box.first.x; x < end_x;) {
        const std::int64_t page_x = std::clamp<std::int64_t>(x, 0, last.x) / kSide;
        const std::int64_t page_end = (page_x + 1) * kSide;
        const std::int64_t end = page_end > last.x ? end_x : std::min(page_end, end_x);
        const std::int32_t entry = table_[static_cast<std::size_t>(first_page + page_x)];
        if (entry < 0) {
          value = std::fill_n(value, end - x, entry == kAllInside ? 1.0F : 0.0F);
          x = end;
          continue;
        }
        const std::uint64_t slice =
            pages_[static_cast<std::size_t>(entry)][static_cast<std::size_t>(row.z % kSide)];
        const std::uint64_t in_row = slice >> (kSide * (row.y % kSide));
        for (; x < end; ++x) {
          const std::int64_t column = std::clamp<std::int64_t>(x, 0, last.x) - page_x * kSide;
          *value++ = static_cast<float>(in_row >> column & 1);
        }
      }
    }
  }
  return block;
}

std::vector<bool> InsideMask::changes_from(const InsideMask& other) const {
  std::vector<bool> changed(table_.size());
  for (std::size_t page = 0; page < table_.size(); ++page) {
    const std::int32_t here = table_[page];
    const std::int32_t there = other.table_[page];
    // Pages that are all inside or all outside have no bits.
    changed[page] = here < 0 || there < 0 ? here != there
                                          : pages_[static_cast<std::size_t>(here)] !=
                                                other.pages_[static_cast<std::size_t>(there)];
  }
  return changed;
}

}  // namespace tidemark::solver
