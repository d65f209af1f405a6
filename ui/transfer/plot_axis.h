// The axis of a plot: from values to pixels and back.
#pragma once

#include <vector>

namespace tidemark {

struct TransferAxis {
  double low = 0.0;
  double high = 1.0;
  // Pixels are linear in (value - low)^power; below 1 it gives small values more room.
  double power = 1.0;
  double pixel_low = 0.0;  // where `low` is; may lie beyond pixel_high (an axis that goes up)
  double pixel_high = 1.0;

  [[nodiscard]] double to_pixel(double value) const;
  [[nodiscard]] double to_value(double pixel) const;
  [[nodiscard]] double extent() const { return high - low; }
};

// Round values within the axis, at least `pixels` from each other.
std::vector<double> ticks(const TransferAxis& axis, double pixels);

}  // namespace tidemark
