// The annotations over pictures: the patient's sides and a scale bar.
#pragma once

#include <string_view>

#include "renderer/camera.h"
#include "renderer/picture.h"

namespace tidemark::renderer {

// Letters (orientation_letters()) at the four edges, or "?" where nobody knows the patient's sides, and a
// scale bar with its length at the lower right; white on a dark rim, so that they are seen on any picture.
// `right` and `up`: unit vectors in the patient (LPS).
void annotate(Picture& picture, glm::dvec3 right, glm::dvec3 up, bool sides_are_known, double mm_per_pixel);

// The longest of 1, 2 and 5 times a power of ten that is no longer than this, in mm.
double scale_bar_mm(double longest_mm);

// Writes at `at` (the upper left, in pixels) in letters of that height. Knows capital A F H L P R, small
// letters, digits, '.', '-', '=', '?' and the space, which is all there is to write; others leave a gap.
void write_text(Picture& picture, glm::dvec2 at, double height, std::string_view text);
// The width of that text, in pixels.
double text_width(double height, std::string_view text);

}  // namespace tidemark::renderer
