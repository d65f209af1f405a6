#include "core/region.h"

#include <algorithm>
#include <cstring>
#include <glm/common.hpp>

#include "core/bit_mask.h"
#include "core/paged_bytes.h"

namespace tidemark {
namespace {

constexpr std::int64_t kBits = Region::kBits;

VoxelRange box_of(const Region& region) {
  return {region.first(), region.first() + region.size()};
}

VoxelRange common_box(const Region& a, const Region& b) {
  return {glm::max(box_of(a).low, box_of(b).low), glm::min(box_of(a).high, box_of(b).high)};
}

// The voxels of a page's row that have that value, the first in the lowest bit.
std::uint64_t word_of(const std::uint8_t* row, std::uint8_t value) {
  constexpr std::uint64_t kLow = 0x0101010101010101;
  std::uint64_t word = 0;
  for (int n = 0; n < 8; ++n) {
    std::uint64_t bytes;
    std::memcpy(&bytes, row + 8 * n, sizeof(bytes));
    bytes ^= kLow * value;  // 0 where it is the value
    const std::uint64_t other = ((bytes & (kLow * 0x7F)) + kLow * 0x7F) | bytes;
    const std::uint64_t same = ~other >> 7U & kLow;
    word |= same * 0x0102040810204080 >> 56U << (8 * n);
  }
  return word;
}

// Adds the voxels of a whole grid for which holds(offset) is true; the region has room for all.
template <class Holds>
void add_voxels(Region& region, Index3 grid_size, const Holds& holds) {
  std::int64_t offset = 0;
  for (std::int64_t k = 0; k < grid_size.z; ++k) {
    for (std::int64_t j = 0; j < grid_size.y; ++j) {
      std::uint64_t* const words = region.row(j, k).data();
      for (std::int64_t i = 0; i < grid_size.x; ++i, ++offset)
        words[i / kBits] |= std::uint64_t{holds(offset) ? 1U : 0U} << (i % kBits);
    }
  }
}

// Calls visit(word of a, word of b) for the words of a box that both have room for; a reference to a
// word of `a` where `a` may be changed.
template <class A, class Visit>
void for_each_common_word(A& a, const Region& b, const Visit& visit) {
  const VoxelRange box = common_box(a, b);
  if (box.empty()) return;
  const auto words = static_cast<std::size_t>((box.high.x - box.low.x) / kBits);
  const auto skip_a = static_cast<std::size_t>((box.low.x - a.first().x) / kBits);
  const auto skip_b = static_cast<std::size_t>((box.low.x - b.first().x) / kBits);
  for (std::int64_t k = box.low.z; k < box.high.z; ++k) {
    for (std::int64_t j = box.low.y; j < box.high.y; ++j) {
      const auto in_a = a.row(j, k).subspan(skip_a, words);
      const auto in_b = b.row(j, k).subspan(skip_b, words);
      for (std::size_t w = 0; w < words; ++w) visit(in_a[w], in_b[w]);
    }
  }
}

}  // namespace

VoxelRange VoxelRange::widened(Index3 voxels, Index3 grid_size) const {
  return {glm::max(low - voxels, Index3(0)), glm::min(high + voxels, grid_size)};
}

Region::Region(const VoxelRange& box) {
  if (box.empty()) return;
  first_ = {box.low.x / kBits * kBits, box.low.y, box.low.z};
  size_ = box.high - first_;
  size_.x = (size_.x + kBits - 1) / kBits * kBits;
  words_.assign(words_a_row() * static_cast<std::size_t>(size_.y * size_.z), 0);
}

Region::Region(const Mask& mask) : Region(VoxelRange{Index3(0), mask.geometry.size}) {
  add_voxels(*this, mask.geometry.size,
             [&](std::int64_t offset) { return mask.voxels[static_cast<std::size_t>(offset)] != 0; });
}

Region::Region(const BitMask& mask) : Region(VoxelRange{Index3(0), mask.geometry().size}) {
  add_voxels(*this, mask.geometry().size, [&](std::int64_t offset) { return mask.contains(offset); });
}

Region::Region(const PagedBytes& values, std::uint8_t value) {
  static_assert(PagedBytes::kPageShape.x == kBits);
  const PageLayout& layout = values.layout();
  std::vector<std::int64_t> pages;  // that hold the value
  VoxelRange box{layout.domain_size(), Index3(0)};
  const auto for_each_word = [&](std::int64_t page, const auto& visit) {
    const Index3 first = layout.first_voxel(page);
    const Index3 shape = layout.valid_shape(page);
    for (std::int64_t z = 0; z < shape.z; ++z) {
      for (std::int64_t y = 0; y < shape.y; ++y) {
        const std::uint8_t* const row = values.page(page) + kBits * (y + PagedBytes::kPageShape.y * z);
        if (const std::uint64_t word = word_of(row, value); word != 0) visit(first + Index3(0, y, z), word);
      }
    }
  };
  for (std::int64_t page = 0; page < layout.page_count(); ++page) {
    if (values.page(page) == nullptr) continue;
    bool any = false;
    for_each_word(page, [&](Index3 voxel, std::uint64_t word) {
      any = true;
      box.low = glm::min(box.low, voxel + Index3(std::countr_zero(word), 0, 0));
      box.high = glm::max(box.high, voxel + Index3(kBits - std::countl_zero(word), 1, 1));
    });
    if (any) pages.push_back(page);
  }
  *this = Region(box);
  for (const std::int64_t page : pages) {
    for_each_word(page, [&](Index3 voxel, std::uint64_t word) {
      row(voxel.y, voxel.z)[static_cast<std::size_t>((voxel.x - first_.x) / kBits)] = word;
    });
  }
}

bool Region::contains(Index3 voxel) const {
  const std::int64_t bit = voxel.x - first_.x;
  if (bit < 0 || bit >= size_.x || !has_row(voxel.y, voxel.z)) return false;
  return (row(voxel.y, voxel.z)[static_cast<std::size_t>(bit / kBits)] >> (bit % kBits) & 1U) != 0;
}

std::int64_t Region::count() const {
  std::int64_t count = 0;
  for (const std::uint64_t word : words_) count += std::popcount(word);
  return count;
}

bool Region::empty() const {
  return std::all_of(words_.begin(), words_.end(), [](std::uint64_t word) { return word == 0; });
}

VoxelRange Region::bounds() const {
  VoxelRange box{first_ + size_, first_};
  bool any = false;
  for_each_run([&](Index3 voxel, std::int64_t length) {
    any = true;
    box.low = glm::min(box.low, voxel);
    box.high = glm::max(box.high, voxel + Index3(length, 1, 1));
  });
  return any ? box : VoxelRange();
}

void Region::add_run(Index3 voxel, std::int64_t length) {
  const auto words = row(voxel.y, voxel.z);
  std::int64_t bit = voxel.x - first_.x;
  const std::int64_t end = bit + length;
  while (bit < end) {
    const std::int64_t begin = bit % kBits;
    const std::int64_t bits = std::min(kBits - begin, end - bit);
    const std::uint64_t ones = ~std::uint64_t{0} >> (kBits - bits);
    words[static_cast<std::size_t>(bit / kBits)] |= ones << begin;
    bit += bits;
  }
}

bool Region::operator==(const Region& other) const {
  const std::int64_t count = this->count();
  return count == other.count() && count == common_count(*this, other);
}

Region intersection(const Region& a, const Region& b) {
  Region result(common_box(a, b));
  for_each_common_word(result, a, [](std::uint64_t& to, std::uint64_t from) { to = from; });
  for_each_common_word(result, b, [](std::uint64_t& to, std::uint64_t from) { to &= from; });
  return result;
}

Region united(const Region& a, const Region& b) {
  if (a.size().x == 0) return b;
  if (b.size().x == 0) return a;
  Region result(VoxelRange{glm::min(box_of(a).low, box_of(b).low), glm::max(box_of(a).high, box_of(b).high)});
  for (const Region* part : {&a, &b})
    for_each_common_word(result, *part, [](std::uint64_t& to, std::uint64_t from) { to |= from; });
  return result;
}

Region difference(const Region& a, const Region& b) {
  Region result = a;
  for_each_common_word(result, b, [](std::uint64_t& to, std::uint64_t from) { to &= ~from; });
  return result;
}

Region whole(const VoxelRange& box) {
  Region all(box);
  if (box.empty()) return all;
  for (std::int64_t k = box.low.z; k < box.high.z; ++k) {
    for (std::int64_t j = box.low.y; j < box.high.y; ++j)
      all.add_run({box.low.x, j, k}, box.high.x - box.low.x);
  }
  return all;
}

Region complement(const Region& region, const VoxelRange& box) {
  return difference(whole(box), region);
}

std::int64_t common_count(const Region& a, const Region& b) {
  std::int64_t common = 0;
  for_each_common_word(a, b,
                       [&](std::uint64_t in_a, std::uint64_t in_b) { common += std::popcount(in_a & in_b); });
  return common;
}

double dice(const Region& a, const Region& b) {
  const std::int64_t both = a.count() + b.count();
  return both == 0 ? 1.0 : 2.0 * static_cast<double>(common_count(a, b)) / static_cast<double>(both);
}

Mask mask_of(const Region& region, const Geometry& grid) {
  Mask mask{grid, std::vector<std::uint8_t>(static_cast<std::size_t>(grid.voxel_count()))};
  region.for_each_run([&](Index3 voxel, std::int64_t length) {
    std::fill_n(mask.voxels.begin() + grid.offset(voxel), length, std::uint8_t{1});
  });
  return mask;
}

std::int64_t most_region_bytes(Index3 grid_size) {
  return (grid_size.x + kBits - 1) / kBits * 8 * grid_size.y * grid_size.z;
}

}  // namespace tidemark
