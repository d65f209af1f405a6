// The handles of a primitive, and the effect of moving them. Geometry alone: nothing is painted here.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "ui/transfer/axis_primitive.h"

namespace tidemark::ui {

// The part of a factor that a handle moves. `below` and `above` are the two sides of a Gaussian: either sets
// its width.
enum class Grip { none, whole, start, end, below, above };

// In a plot whose axes are those of the first two factors, or the first factor's and opacity.
struct HandleKind {
  Grip x = Grip::none;
  Grip y = Grip::none;
  bool opacity = false;

  bool operator==(const HandleKind&) const = default;
};

struct Handle {
  HandleKind kind;
  glm::dvec2 at{0.0};  // in the axes' units
};

struct Extent {
  double low = 0.0;
  double high = 1.0;
};

// On the primitive's curve of opacity, whose ends and centre are at some height of it. `x` is what the plot
// shows.
std::vector<Handle> curve_handles(const AxisPrimitive& primitive, const Extent& x);
// On the first two axes.
std::vector<Handle> plane_handles(const AxisPrimitive& primitive, const Extent& x, const Extent& y);

// The primitive once the handle has been moved to `to`. No width and no ramp is made shorter than
// `smallest` of its axis.
AxisPrimitive moved(AxisPrimitive primitive, const HandleKind& handle, glm::dvec2 to, glm::dvec2 smallest);
renderer::TransferFactor moved(renderer::TransferFactor factor, Grip grip, double to, double smallest);

// Where the factor's middle is: a Gaussian's centre, a ramp's middle, that of `shown` when everything counts.
double middle_of(const renderer::TransferFactor& factor, const Extent& shown);
// From where to where it matters: a Gaussian's width to both sides, a ramp from its start to the end of what
// is shown.
Extent reach_of(const renderer::TransferFactor& factor, const Extent& shown);
// Makes the extent hold a Gaussian's centre (of its sides, the one towards the middle is in reach) or a
// ramp's ends.
void include(Extent& extent, const renderer::TransferFactor& factor);

}  // namespace tidemark::ui
