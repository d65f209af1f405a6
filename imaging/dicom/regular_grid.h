// The regular grid that slices make, as they lie in the patient: which slices, and how.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "core/geometry.h"
#include "imaging/grid_policy.h"

namespace tidemark::imaging {

// Parallel slices of one size, or one alone, in the order of their places along the normal, no two at one
// place.
struct ImageStack {
  Index3 size{0};                        // columns, rows, slices
  glm::dvec2 spacing_mm{1.0};            // of pixels along i and j
  double thickness_mm = 1.0;             // of a slice that is alone, which has no distance to another
  glm::dmat3 axes{1.0};                  // i, j and their normal, orthonormal
  std::vector<glm::dvec3> positions_mm;  // of each slice's first pixel
  std::vector<std::string> names;        // of the slices, for messages
};

// A slice's share in a slice of the grid. Its pixel (i, j) lies at (i, j) + shift of the grid's slice.
struct SliceShare {
  std::int64_t slice = 0;
  double weight = 0.0;
  glm::dvec2 shift{0.0};
};

// The shares of one slice, or of two neighbours (the second's weight is 0 where there is one), which add up
// to 1.
using GridSlice = std::array<SliceShare, 2>;

struct GridPlan {
  Geometry geometry;
  std::vector<GridSlice> slices;  // none: slice k of the grid is slice k of the stack, pixel by pixel
  std::vector<std::string> changes;
  std::vector<std::string> warnings;
  std::string refusal;   // the reason why the policy allows no grid, one line that names the slices
  std::string question;  // for the user, where only the policy forbids filling gaps
  std::string tilt;      // the tilt in a sentence, where slices can be moved back or not
};

// Slices may move sideways in proportion to their distance, by at most 45 degrees (gantry tilt). Where they
// are missing (distances are whole multiples) the grid has the slices that are there, and linear
// interpolation between them; where distances are uneven otherwise, all is interpolated to the smallest usual
// one, from the first slice on. No grid has more than four times the voxels of its slices. A slice alone is a
// grid as it is.
[[nodiscard]] GridPlan plan_regular_grid(const ImageStack& stack, const GridPolicy& policy);

}  // namespace tidemark::imaging
