#include "ui/transfer/primitive_handles.h"

#include <algorithm>
#include <cmath>

namespace tidemark::ui {
namespace {

using Kind = renderer::TransferFactor::Kind;

struct FactorHandle {
  Grip grip;
  double at;
};

// The ends first: among overlapping handles the first is dragged, and a centre can be dragged elsewhere.
std::vector<FactorHandle> end_handles(const renderer::TransferFactor& factor) {
  switch (factor.kind) {
    case Kind::gaussian:
      return {{Grip::below, factor.start - factor.end}, {Grip::above, factor.start + factor.end}};
    case Kind::ramp:
      return {{Grip::start, factor.start}, {Grip::end, factor.end}};
    case Kind::everything:
      break;
  }
  return {};
}

Grip whole_of(const renderer::TransferFactor& factor) {
  return factor.kind == Kind::everything ? Grip::none : Grip::whole;
}

// On a ramp's plateau, as far as it is shown; at a Gaussian's peak.
double top_of(const renderer::TransferFactor& factor, const Extent& shown) {
  if (factor.kind != Kind::ramp) return middle_of(factor, shown);
  const double side = factor.end > factor.start ? shown.high : shown.low;
  const double ahead = factor.end + 0.06 * std::copysign(shown.high - shown.low, factor.end - factor.start);
  return factor.end > factor.start ? std::max(std::min(ahead, side), factor.end)
                                   : std::min(std::max(ahead, side), factor.end);
}

}  // namespace

std::vector<Handle> curve_handles(const AxisPrimitive& primitive, const Extent& x) {
  const renderer::TransferFactor& factor = primitive.factors[0];
  std::vector<Handle> handles;
  for (const FactorHandle& end : end_handles(factor)) {
    handles.push_back({{end.grip, Grip::none, false}, {end.at, primitive.opacity * factor.at(end.at)}});
  }
  // A Gaussian's centre is as high as its ends, so that the peak is left to opacity.
  const double height = factor.kind == Kind::gaussian ? std::exp(-1.0) : 0.5;
  if (whole_of(factor) == Grip::whole) {
    handles.push_back({{Grip::whole, Grip::none, false}, {middle_of(factor, x), primitive.opacity * height}});
  }
  handles.push_back({{Grip::none, Grip::none, true}, {top_of(factor, x), primitive.opacity}});
  return handles;
}

std::vector<Handle> plane_handles(const AxisPrimitive& primitive, const Extent& x, const Extent& y) {
  const renderer::TransferFactor& along = primitive.factors[0];
  const renderer::TransferFactor& up = primitive.factors[1];
  const glm::dvec2 middle{middle_of(along, x), middle_of(up, y)};
  std::vector<Handle> handles;
  for (const FactorHandle& end : end_handles(along)) {
    handles.push_back({{end.grip, Grip::none, false}, {end.at, middle.y}});
  }
  for (const FactorHandle& end : end_handles(up)) {
    handles.push_back({{Grip::none, end.grip, false}, {middle.x, end.at}});
  }
  const HandleKind whole{whole_of(along), whole_of(up), false};
  if (!(whole == HandleKind{})) handles.push_back({whole, middle});
  return handles;
}

AxisPrimitive moved(AxisPrimitive primitive, const HandleKind& handle, glm::dvec2 to, glm::dvec2 smallest) {
  primitive.factors[0] = moved(primitive.factors[0], handle.x, to.x, smallest.x);
  primitive.factors[1] = moved(primitive.factors[1], handle.y, to.y, smallest.y);
  if (handle.opacity) primitive.opacity = std::max(0.0, to.y);
  return primitive;
}

renderer::TransferFactor moved(renderer::TransferFactor factor, Grip grip, double to, double smallest) {
  const double length = factor.end - factor.start;
  switch (grip) {
    case Grip::none:
      break;
    case Grip::whole:
      factor.start = factor.kind == Kind::ramp ? to - 0.5 * length : to;
      if (factor.kind == Kind::ramp) factor.end = factor.start + length;
      break;
    case Grip::start:
      factor.start = to;
      // At its other end it turns round: the ramp falls where it rose.
      if (std::abs(factor.end - to) < smallest) factor.start = factor.end - std::copysign(smallest, length);
      break;
    case Grip::end:
      factor.end = to;
      if (std::abs(to - factor.start) < smallest) factor.end = factor.start + std::copysign(smallest, length);
      break;
    case Grip::below:
      factor.end = std::max(smallest, factor.start - to);
      break;
    case Grip::above:
      factor.end = std::max(smallest, to - factor.start);
      break;
  }
  return factor;
}

double middle_of(const renderer::TransferFactor& factor, const Extent& shown) {
  if (factor.kind == Kind::gaussian) return factor.start;
  if (factor.kind == Kind::ramp) return 0.5 * (factor.start + factor.end);
  return 0.5 * (shown.low + shown.high);
}

Extent reach_of(const renderer::TransferFactor& factor, const Extent& shown) {
  if (factor.kind == Kind::gaussian) return {factor.start - factor.end, factor.start + factor.end};
  if (factor.kind == Kind::everything) return shown;
  return factor.end > factor.start ? Extent{factor.start, std::max(factor.end, shown.high)}
                                   : Extent{std::min(factor.end, shown.low), factor.start};
}

void include(Extent& extent, const renderer::TransferFactor& factor) {
  if (factor.kind == Kind::everything) return;
  const double other = factor.kind == Kind::ramp ? factor.end : factor.start;
  extent.low = std::min({extent.low, factor.start, other});
  extent.high = std::max({extent.high, factor.start, other});
}

}  // namespace tidemark::ui
