#include "ui/widgets/plot_axis.h"

#include <algorithm>
#include <cmath>

namespace tidemark::ui {
namespace {

// 1, 2 or 5 times a power of ten, not below `least`.
double round_step(double least) {
  const double decade = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * decade >= least * (1.0 - 1e-9)) return factor * decade;
  }
  return 10.0 * decade;
}

}  // namespace

double PlotAxis::pixel(double value) const {
  const double share = (value - low) / (high - low);
  const double placed = power == 1.0 ? share : std::copysign(std::pow(std::abs(share), power), share);
  return from + placed * (to - from);
}

double PlotAxis::value(double pixel) const {
  const double placed = (pixel - from) / (to - from);
  const double share = power == 1.0 ? placed : std::copysign(std::pow(std::abs(placed), 1.0 / power), placed);
  return low + share * (high - low);
}

std::vector<double> ticks(const PlotAxis& axis, double pixels) {
  const double room = std::abs(axis.to - axis.from);
  std::vector<double> values;
  if (!(axis.extent() > 0.0) || room < pixels) return values;
  if (axis.power == 1.0) {
    const double step = round_step(axis.extent() * pixels / room);
    for (double n = std::ceil(axis.low / step - 1e-9); n * step <= axis.high + 1e-9 * step; n += 1.0) {
      values.push_back(n * step);
    }
    return values;
  }
  // Powers of ten, where small values have more room.
  values.push_back(axis.high);
  for (double value = std::pow(10.0, std::floor(std::log10(axis.high))); value > axis.high * 1e-5;
       value /= 10.0) {
    if (std::abs(axis.pixel(value) - axis.pixel(values.back())) >= pixels) values.push_back(value);
  }
  while (values.size() > 1 && std::abs(axis.pixel(values.back()) - axis.from) < pixels) values.pop_back();
  values.push_back(axis.low);
  std::reverse(values.begin(), values.end());
  return values;
}

}  // namespace tidemark::ui
