#include "document/inside_bits.h"

#include <algorithm>
#include <bit>
#include <glm/common.hpp>

namespace tidemark::document {
namespace {

constexpr std::int64_t kBits = 8;  // a byte

bool any_inside(const solver::Field& phi, std::int64_t page) {
  const float* const values = phi.pages.values(page);
  if (values == nullptr) return phi.pages.kind(page) == solver::Field::Kind::inside;
  const Index3 valid = phi.layout.valid_shape(page);
  const Index3 shape = phi.layout.page_shape();
  for (std::int64_t z = 0; z < valid.z; ++z) {
    for (std::int64_t y = 0; y < valid.y; ++y) {
      const float* const row = values + (z * shape.y + y) * shape.x;
      if (std::any_of(row, row + valid.x, [](float value) { return value > 0.0F; })) return true;
    }
  }
  return false;
}

}  // namespace

InsideBits::InsideBits(const solver::Field& phi) {
  std::vector<std::int64_t> pages;
  Index3 low = phi.geometry.size;
  Index3 high(0);
  for (std::int64_t page = 0; page < phi.layout.page_count(); ++page) {
    if (!any_inside(phi, page)) continue;
    pages.push_back(page);
    const Index3 first = phi.layout.first_voxel(page);
    low = glm::min(low, first);
    high = glm::max(high, first + phi.layout.valid_shape(page));
  }
  if (pages.empty()) return;
  make_room(low, high);
  for (const std::int64_t page : pages) add_page(phi, page);
  count_bits();
}

InsideBits::InsideBits(const Mask& mask) {
  make_room(Index3(0), mask.geometry.size);
  const std::uint8_t* value = mask.voxels.data();
  for (std::int64_t k = 0; k < size_.z; ++k) {
    for (std::int64_t j = 0; j < size_.y; ++j) {
      std::uint8_t* const bits = row_at(j, k);
      for (std::int64_t i = 0; i < mask.geometry.size.x; ++i) {
        if (*value++ != 0) bits[i / kBits] |= static_cast<std::uint8_t>(1U << (i % kBits));
      }
    }
  }
  count_bits();
}

void InsideBits::make_room(Index3 low, Index3 high) {
  first_ = {low.x / kBits * kBits, low.y, low.z};
  size_ = high - first_;
  size_.x = (size_.x + kBits - 1) / kBits * kBits;
  bits_.assign(static_cast<std::size_t>(size_.x / kBits * size_.y * size_.z), 0);
}

std::uint8_t* InsideBits::row_at(std::int64_t j, std::int64_t k) {
  return bits_.data() + ((k - first_.z) * size_.y + j - first_.y) * (size_.x / kBits);
}

std::span<const std::uint8_t> InsideBits::row(std::int64_t j, std::int64_t k) const {
  const auto length = static_cast<std::size_t>(size_.x / kBits);
  return {bits_.data() + static_cast<std::size_t>((k - first_.z) * size_.y + j - first_.y) * length, length};
}

void InsideBits::add_page(const solver::Field& phi, std::int64_t page) {
  const Index3 first = phi.layout.first_voxel(page);
  const Index3 valid = phi.layout.valid_shape(page);
  const Index3 shape = phi.layout.page_shape();
  const float* const values = phi.pages.values(page);  // null: all inside
  for (std::int64_t z = 0; z < valid.z; ++z) {
    for (std::int64_t y = 0; y < valid.y; ++y) {
      std::uint8_t* const bits = row_at(first.y + y, first.z + z);
      const float* const row = values == nullptr ? nullptr : values + (z * shape.y + y) * shape.x;
      for (std::int64_t x = 0; x < valid.x; ++x) {
        const std::int64_t bit = first.x - first_.x + x;
        if (row == nullptr || row[x] > 0.0F)
          bits[bit / kBits] |= static_cast<std::uint8_t>(1U << (bit % kBits));
      }
    }
  }
}

void InsideBits::count_bits() {
  for (const std::uint8_t byte : bits_) count_ += std::popcount(byte);
}

bool InsideBits::contains(Index3 voxel) const {
  const Index3 at = voxel - first_;
  if (at.x < 0 || at.y < 0 || at.z < 0 || at.x >= size_.x || at.y >= size_.y || at.z >= size_.z) return false;
  return (row(voxel.y, voxel.z)[static_cast<std::size_t>(at.x / kBits)] >> (at.x % kBits) & 1U) != 0;
}

std::int64_t most_inside_bytes(Index3 grid_size) {
  return (grid_size.x + kBits - 1) / kBits * grid_size.y * grid_size.z;
}

double dice(const InsideBits& a, const InsideBits& b) {
  if (a.count() + b.count() == 0) return 1.0;
  const Index3 low = glm::max(a.first(), b.first());
  const Index3 high = glm::min(a.first() + a.size(), b.first() + b.size());
  std::int64_t common = 0;
  for (std::int64_t k = low.z; k < high.z; ++k) {
    for (std::int64_t j = low.y; j < high.y; ++j) {
      const auto in_a = a.row(j, k);
      const auto in_b = b.row(j, k);
      for (std::int64_t i = low.x; i < high.x; i += kBits) {
        const std::uint8_t both = in_a[static_cast<std::size_t>((i - a.first().x) / kBits)] &
                                  in_b[static_cast<std::size_t>((i - b.first().x) / kBits)];
        common += std::popcount(both);
      }
    }
  }
  return 2.0 * static_cast<double>(common) / static_cast<double>(a.count() + b.count());
}

}  // namespace tidemark::document
