// The policy for a series whose slices make no regular grid.
#pragma once

namespace tidemark::imaging {

struct GridPolicy {
  // Slices that move sideways as they advance (gantry tilt): moved back within their planes, or taken as if
  // they lay above each other.
  enum class Tilt { correct, keep };
  // Missing slices and uneven distances: not loaded, or interpolated between neighbours.
  enum class Gaps { refuse, fill };

  Tilt tilt = Tilt::correct;
  Gaps gaps = Gaps::refuse;

  bool operator==(const GridPolicy&) const = default;
};

}  // namespace tidemark::imaging
