// The number by which other systems call a slice.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace tidemark::imaging {

struct Series;

struct SliceNumber {
  std::optional<std::int64_t> instance;  // (0020,0013)
  std::optional<std::int64_t> frame;     // from 1, in a file of several

  bool operator==(const SliceNumber&) const = default;
};

// Of each slice of the volume that a loadable series becomes. A slice that is made of two images has none,
// and a file whose frames are all of the series names frames alone. Empty for a volume file.
[[nodiscard]] std::vector<SliceNumber> slice_numbers(const Series& series);

}  // namespace tidemark::imaging
