// From values to pixels.
#pragma once

#include <algorithm>
#include <cmath>

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

// The step of a scale with at most `most` marks on a span: 1, 2 or 5 times a power of ten.
inline double scale_step(double span, int most) {
  const double rough = span / std::max(most, 1);
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough) return factor * power;
  }
  return 10.0 * power;
}

}  // namespace tidemark
