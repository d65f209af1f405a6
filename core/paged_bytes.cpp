#include "core/paged_bytes.h"

#include <algorithm>
#include <glm/common.hpp>
#include <numeric>

#include "core/paging/page_rows.h"

namespace tidemark {
namespace {

constexpr std::int64_t kPageVoxels =
    PagedBytes::kPageShape.x * PagedBytes::kPageShape.y * PagedBytes::kPageShape.z;

// Calls visit(page, its first voxel, first voxel of the part, first one after it) for the parts of a box that
// lie in one page each.
template <class Visit>
void for_each_part(const PageLayout& layout, Index3 first, Index3 shape, const Visit& visit) {
  const Index3 page_shape = layout.page_shape();
  const Index3 end = first + shape;
  Index3 page;
  for (page.z = first.z / page_shape.z; page.z * page_shape.z < end.z; ++page.z) {
    for (page.y = first.y / page_shape.y; page.y * page_shape.y < end.y; ++page.y) {
      for (page.x = first.x / page_shape.x; page.x * page_shape.x < end.x; ++page.x) {
        const Index3 corner = page * page_shape;
        visit(layout.page_number(page), corner, glm::max(first, corner), glm::min(end, corner + page_shape));
      }
    }
  }
}

// Calls visit(page, index in the page, index in the box, length) for their rows along i.
template <class Visit>
void for_each_box_row(const PageLayout& layout, Index3 first, Index3 shape, const Visit& visit) {
  const Index3 page_shape = layout.page_shape();
  for_each_part(layout, first, shape, [&](std::int64_t page, Index3 corner, Index3 low, Index3 high) {
    for (std::int64_t z = low.z; z < high.z; ++z) {
      for (std::int64_t y = low.y; y < high.y; ++y) {
        const Index3 row(low.x, y, z);
        visit(page, number_in(page_shape, row - corner), number_in(shape, row - first), high.x - low.x);
      }
    }
  });
}

}  // namespace

PagedBytes::PagedBytes(Index3 size, std::uint8_t rest)
    : layout_(size, kPageShape), rest_(rest), pages_(layout_.page_count(), kPageVoxels) {}

PagedBytes::PagedBytes(Index3 size, std::span<const std::uint8_t> voxels, std::uint8_t rest)
    : PagedBytes(size, rest) {
  Geometry grid;
  grid.size = size;
  for (std::int64_t page = 0; page < layout_.page_count(); ++page) {
    std::uint8_t* const values = change(page);
    for_each_row(grid, layout_, page, [&](std::int64_t offset, std::int64_t length, std::int64_t index) {
      std::copy_n(voxels.data() + offset, length, values + index);
    });
    join_even_page(page);
  }
}

void PagedBytes::read(Index3 first, Index3 shape, std::uint8_t* into) const {
  for_each_box_row(layout_, first, shape,
                   [&](std::int64_t page, std::int64_t index, std::int64_t in_box, std::int64_t length) {
                     const std::uint8_t* const values = pages_.values(page);
                     if (values == nullptr) {
                       std::fill_n(into + in_box, length, rest_);
                     } else {
                       std::copy_n(values + index, length, into + in_box);
                     }
                   });
}

std::vector<std::uint8_t> PagedBytes::voxels() const {
  const Index3 size = this->size();
  std::vector<std::uint8_t> all(static_cast<std::size_t>(size.x * size.y * size.z));
  read(Index3(0), size, all.data());
  return all;
}

std::array<std::int64_t, 256> PagedBytes::counts() const {
  std::array<std::int64_t, 256> counts{};
  for (const std::int64_t page : pages_.stored_pages()) {
    const std::uint8_t* const values = pages_.values(page);
    for (std::int64_t i = 0; i < kPageVoxels; ++i) ++counts[values[i]];
  }
  // Beyond the grid's end values are `rest`, too.
  counts[rest_] = 0;
  const Index3 size = this->size();
  counts[rest_] = size.x * size.y * size.z - std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
  return counts;
}

std::optional<std::uint8_t> PagedBytes::even_value(Index3 first, Index3 shape) const {
  std::optional<std::uint8_t> value;
  bool even = true;
  for_each_part(layout_, first, shape, [&](std::int64_t page, Index3, Index3, Index3) {
    const std::uint8_t* const values = pages_.values(page);
    const std::uint8_t here = values == nullptr ? rest_ : *values;
    even = even && value.value_or(here) == here && (values == nullptr || values == even_pages().values(here));
    value = here;
  });
  return even ? value : std::nullopt;
}

void PagedBytes::fill(Index3 first, Index3 shape, std::uint8_t value) {
  for_each_box_row(layout_, first, shape,
                   [&](std::int64_t page, std::int64_t index, std::int64_t, std::int64_t length) {
                     if (value != rest_ || pages_.values(page) != nullptr)
                       std::fill_n(change(page) + index, length, value);
                   });
}

void PagedBytes::write(Index3 first, Index3 shape, const std::uint8_t* values) {
  for_each_box_row(layout_, first, shape,
                   [&](std::int64_t page, std::int64_t index, std::int64_t in_box, std::int64_t length) {
                     std::copy_n(values + in_box, length, change(page) + index);
                   });
}

void PagedBytes::own(Index3 first, Index3 shape) {
  for_each_part(layout_, first, shape,
                [&](std::int64_t page, Index3, Index3, Index3) { (void)change(page); });
}

std::uint8_t* PagedBytes::change(std::int64_t page) {
  if (pages_.is_stored(page)) return pages_.change(page);
  std::uint8_t* const values = pages_.store(page);
  std::fill_n(values, kPageVoxels, rest_);
  return values;
}

const PagedBytes::Pages& PagedBytes::even_pages() {
  static const Pages pages = [] {
    Pages made(256, kPageVoxels);
    for (std::int64_t n = 0; n < made.size(); ++n)
      std::fill_n(made.store(n), kPageVoxels, static_cast<std::uint8_t>(n));
    return made;
  }();
  return pages;
}

void PagedBytes::join_even_page(std::int64_t page) {
  const std::uint8_t* const values = pages_.values(page);
  if (values == nullptr) return;
  const std::uint8_t value = *values;
  const bool is_even = std::equal(values, values + kPageVoxels - 1, values + 1);
  if (!is_even) return;
  if (value == rest_) {
    pages_.set_constant(page, Pages::Kind::outside);
  } else {
    pages_.share(page, even_pages(), value);
  }
}

void PagedBytes::join_even_pages(const PagedBytes& since) {
  std::vector<std::int64_t> differing;
  Pages::for_each_difference(since.pages_, pages_, [&](std::int64_t page) { differing.push_back(page); });
  for (const std::int64_t page : differing) join_even_page(page);
}

bool PagedBytes::operator==(const PagedBytes& other) const {
  if (size() != other.size()) return false;
  bool same = true;
  for_each_difference(*this, other, [&](Index3, std::int64_t, std::uint8_t, std::uint8_t) { same = false; });
  return same;
}

}  // namespace tidemark
