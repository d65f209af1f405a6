#include "core/shared_slices.h"

#include <algorithm>

namespace tidemark {

SharedSlices::SharedSlices(Index3 size, std::uint8_t rest)
    : size_(size), rest_(rest), slices_(static_cast<std::size_t>(size.z)) {}

SharedSlices::SharedSlices(Index3 size, std::span<const std::uint8_t> voxels, std::uint8_t rest)
    : SharedSlices(size, rest) {
  const auto length = static_cast<std::size_t>(area());
  for (std::int64_t k = 0; k < size.z; ++k) {
    const auto values = voxels.subspan(static_cast<std::size_t>(k) * length, length);
    if (std::all_of(values.begin(), values.end(), [rest](std::uint8_t value) { return value == rest; }))
      continue;
    std::copy(values.begin(), values.end(), change(k));
  }
}

bool SharedSlices::empty() const {
  return std::all_of(slices_.begin(), slices_.end(), [](const auto& slice) { return slice == nullptr; });
}

std::int64_t SharedSlices::bytes() const {
  const auto count =
      std::count_if(slices_.begin(), slices_.end(), [](const auto& slice) { return slice != nullptr; });
  return count * area();
}

std::span<const std::uint8_t> SharedSlices::slice(std::int64_t k) const {
  const std::uint8_t* const values = slices_[static_cast<std::size_t>(k)].get();
  return {values, values == nullptr ? 0 : static_cast<std::size_t>(area())};
}

std::span<const std::uint8_t> SharedSlices::row(std::int64_t j, std::int64_t k) const {
  const std::span<const std::uint8_t> values = slice(k);
  if (values.empty()) return {};
  return values.subspan(static_cast<std::size_t>(size_.x * j), static_cast<std::size_t>(size_.x));
}

void SharedSlices::read(std::int64_t k, std::span<std::uint8_t> into) const {
  const std::span<const std::uint8_t> values = slice(k);
  std::copy(values.begin(), values.end(), into.begin());
  if (values.empty()) std::fill(into.begin(), into.end(), rest_);
}

std::vector<std::uint8_t> SharedSlices::voxels() const {
  std::vector<std::uint8_t> all(static_cast<std::size_t>(area() * size_.z));
  for (std::int64_t k = 0; k < size_.z; ++k)
    read(k, std::span(all).subspan(static_cast<std::size_t>(area() * k), static_cast<std::size_t>(area())));
  return all;
}

std::uint8_t* SharedSlices::change(std::int64_t k) {
  std::shared_ptr<std::uint8_t[]>& slice = slices_[static_cast<std::size_t>(k)];
  if (slice == nullptr || slice.use_count() > 1) {
    const auto count = static_cast<std::size_t>(area());
    auto own = std::make_shared_for_overwrite<std::uint8_t[]>(count);
    read(k, {own.get(), count});
    slice = std::move(own);
  }
  return slice.get();
}

void SharedSlices::fill(std::int64_t first, std::int64_t length, std::uint8_t value) {
  for (const std::int64_t end = first + length; first < end;) {
    const std::int64_t k = first / area();
    const std::int64_t count = std::min(end, (k + 1) * area()) - first;
    if (value != rest_ || !slice(k).empty()) std::fill_n(change(k) + first % area(), count, value);
    first += count;
  }
}

std::vector<std::int64_t> SharedSlices::differing_slices(const SharedSlices& other) const {
  std::vector<std::int64_t> differing;
  for (std::int64_t k = 0; k < size_.z; ++k) {
    if (size_ != other.size_ || slice(k).data() != other.slice(k).data()) differing.push_back(k);
  }
  return differing;
}

}  // namespace tidemark
