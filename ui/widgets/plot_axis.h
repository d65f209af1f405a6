// An axis of a plot: from values to pixels and back.
#pragma once

#include <vector>

namespace tidemark::ui {

struct PlotAxis {
  double low = 0.0;    // value
  double high = 1.0;   // value, > low
  double from = 0.0;   // pixel of `low`; may lie beyond `to` (an axis that goes up)
  double to = 1.0;     // pixel of `high`
  double power = 1.0;  // pixels are linear in (value - low)^power; below 1 small values have more room

  [[nodiscard]] double pixel(double value) const;
  [[nodiscard]] double value(double pixel) const;
  [[nodiscard]] double extent() const { return high - low; }
  [[nodiscard]] bool holds(double value) const { return value >= low && value <= high; }
};

// Round values within the axis, at least `pixels` from each other.
std::vector<double> ticks(const PlotAxis& axis, double pixels);

}  // namespace tidemark::ui
