// A byte for each voxel of a grid, in pages that copies share until one of them is changed.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/paging/page_layout.h"
#include "core/paging/shared_pages.h"

namespace tidemark {

// A page that holds the value `rest` alone takes no memory, and neither does one that join_even_pages() found
// to hold any other value alone.
//
// A copy costs 16 bytes for 512 pages. What differs between two values that come from one another is known
// from where their pages lie, so nobody has to compare voxels.
class PagedBytes {
 public:
  // A row of a page is a word of a Region.
  static constexpr Index3 kPageShape{64, 8, 8};

  PagedBytes() = default;  // of no voxel
  explicit PagedBytes(Index3 size, std::uint8_t rest = 0);
  // `voxels` are in voxel order, as many as the grid has.
  PagedBytes(Index3 size, std::span<const std::uint8_t> voxels, std::uint8_t rest = 0);

  [[nodiscard]] const PageLayout& layout() const { return layout_; }
  [[nodiscard]] Index3 size() const { return layout_.domain_size(); }
  // Whether no page takes memory.
  [[nodiscard]] bool empty() const { return pages_.stored() == 0; }
  [[nodiscard]] std::int64_t bytes() const { return pages_.bytes(); }  // as if nothing were shared

  [[nodiscard]] std::uint8_t at(Index3 voxel) const {
    const Place place = place_of(voxel);
    const std::uint8_t* const values = pages_.values(place.page);
    return values == nullptr ? rest_ : values[place.index];
  }
  // At the eight corners of a box, i fastest: `high` is its last voxel.
  [[nodiscard]] std::array<std::uint8_t, 8> corners(Index3 low, Index3 high) const;
  // The values of a page; null where it holds `rest` alone. Beyond the grid's end they are `rest`.
  [[nodiscard]] const std::uint8_t* page(std::int64_t number) const { return pages_.values(number); }
  // The values of a box of the grid, i fastest.
  void read(Index3 first, Index3 shape, std::uint8_t* into) const;
  [[nodiscard]] std::vector<std::uint8_t> voxels() const;  // in voxel order
  // How many voxels have each value.
  [[nodiscard]] std::array<std::int64_t, 256> counts() const;
  // The one value of a box, where its pages say so without a look at voxels.
  [[nodiscard]] std::optional<std::uint8_t> even_value(Index3 first, Index3 shape) const;

  // Boxes of the grid: one value, and values with i fastest. Copies keep what they were.
  void fill(Index3 first, Index3 shape, std::uint8_t value);
  void write(Index3 first, Index3 shape, const std::uint8_t* values);
  // No copy shares the pages of the box any more. Until the next copy is made, several threads may write to
  // it.
  void own(Index3 first, Index3 shape);
  // Pages that changed since that value, of the same grid, and hold one value alone: they share their memory.
  void join_even_pages(const PagedBytes& since);

  // Calls visit(first voxel, length, value in a, value in b) for runs along i, at most a page long, in voxel
  // order within eight rows of eight slices. Both are of one grid and have the same `rest`.
  template <class Visit>
  static void for_each_difference(const PagedBytes& a, const PagedBytes& b, const Visit& visit);
  // The same voxels.
  bool operator==(const PagedBytes& other) const;

 private:
  // What has no sign is divided by shifting.
  static constexpr glm::u64vec3 kShape{kPageShape};
  struct Place {
    std::int64_t page;
    std::uint64_t index;
  };
  [[nodiscard]] Place place_of(glm::u64vec3 voxel) const {
    const glm::u64vec3 page = voxel / kShape;
    const glm::u64vec3 at = voxel % kShape;
    return {static_cast<std::int64_t>(number_in(glm::u64vec3(layout_.pages()), page)), number_in(kShape, at)};
  }
  using Pages = BasicSharedPages<std::uint8_t>;
  static const Pages& even_pages();  // page n holds n alone
  [[nodiscard]] std::uint8_t value_in(const std::uint8_t* page, std::int64_t index) const {
    return page == nullptr ? rest_ : page[index];
  }
  [[nodiscard]] std::uint8_t* change(std::int64_t page);
  void join_even_page(std::int64_t page);

  PageLayout layout_;
  std::uint8_t rest_ = 0;
  Pages pages_;
};

// In one page as a rule: it is then found once.
inline std::array<std::uint8_t, 8> PagedBytes::corners(Index3 low, Index3 high) const {
  std::array<std::uint8_t, 8> found;
  const Place first = place_of(low);
  const Place last = place_of(high);
  if (first.page == last.page) {
    const std::uint8_t* const values = pages_.values(first.page);
    const Index3 step = (high - low) * Index3(1, kPageShape.x, kPageShape.x * kPageShape.y);
    for (std::size_t n = 0; n < found.size(); ++n) {
      const std::int64_t index = (n & 1 ? step.x : 0) + (n & 2 ? step.y : 0) + (n & 4 ? step.z : 0);
      found[n] = values == nullptr ? rest_ : values[static_cast<std::int64_t>(first.index) + index];
    }
    return found;
  }
  for (std::size_t n = 0; n < found.size(); ++n)
    found[n] = at({(n & 1 ? high : low).x, (n & 2 ? high : low).y, (n & 4 ? high : low).z});
  return found;
}

// Page by page along i, so that a row's runs follow each other.
template <class Visit>
void PagedBytes::for_each_difference(const PagedBytes& a, const PagedBytes& b, const Visit& visit) {
  std::vector<std::int64_t> differing;
  Pages::for_each_difference(a.pages_, b.pages_, [&](std::int64_t page) { differing.push_back(page); });
  const std::int64_t a_row = a.layout_.pages().x;
  for (std::size_t begin = 0, end = 0; begin < differing.size(); begin = end) {
    while (end < differing.size() && differing[end] / a_row == differing[begin] / a_row) ++end;
    const Index3 rows = a.layout_.valid_shape(differing[begin]);
    for (std::int64_t z = 0; z < rows.z; ++z) {
      for (std::int64_t y = 0; y < rows.y; ++y) {
        for (std::size_t n = begin; n < end; ++n) {
          const std::uint8_t* const in_a = a.pages_.values(differing[n]);
          const std::uint8_t* const in_b = b.pages_.values(differing[n]);
          const Index3 first = a.layout_.first_voxel(differing[n]) + Index3(0, y, z);
          const std::int64_t length = a.layout_.valid_shape(differing[n]).x;
          const std::int64_t row = number_in(kPageShape, Index3(0, y, z));
          for (std::int64_t i = 0; i < length;) {
            const std::uint8_t before = a.value_in(in_a, row + i);
            const std::uint8_t after = b.value_in(in_b, row + i);
            const std::int64_t run = i++;
            while (i < length && a.value_in(in_a, row + i) == before && b.value_in(in_b, row + i) == after)
              ++i;
            if (before != after) visit(first + Index3(run, 0, 0), i - run, before, after);
          }
        }
      }
    }
  }
}

}  // namespace tidemark
