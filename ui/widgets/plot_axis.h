// From values to pixels.
#pragma once

namespace tidemark {

struct PlotAxis {
  double low = 0.0;   // value
  double high = 1.0;  // value, > low
  double from = 0.0;  // pixel of `low`
  double to = 1.0;    // pixel of `high`

  [[nodiscard]] double pixel(double value) const { return from + (value - low) / (high - low) * (to - from); }
  [[nodiscard]] double value(double pixel) const { return low + (pixel - from) / (to - from) * (high - low); }
  [[nodiscard]] bool holds(double value) const { return value >= low && value <= high; }
};

}  // namespace tidemark
