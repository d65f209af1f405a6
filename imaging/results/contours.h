// Closed contours around the inside of a slice. Private to this folder.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <vector>

#include "imaging/results/segments.h"

namespace tidemark::imaging {

// In voxel coordinates (i, j), whole numbers at voxel centres; the last point joins the first.
using Contour = std::vector<glm::dvec2>;

// The contours where values change sign, by marching squares: inside is value(i, j) > 0, for 0 <= i < columns
// and 0 <= j < rows; what lies beyond is outside, and the contour closes on the outer faces of the border's
// voxels. They go round what is inside in one direction (positive area, i to the right and j up).
//
// A hole is cut out by a keyhole: its contour is joined to the outer one by a channel without width (DICOM
// PS3.3 C.8.8.6.3), so that each contour that comes back is one region. Readers differ in what two nested
// contours mean, some combine them by "or"; a keyhole means the same to all of them.
//
// A voxel's centre is inside the contours exactly when its value is > 0, with some distance to spare.
std::vector<Contour> trace_contours(std::int64_t columns, std::int64_t rows,
                                    const std::function<double(std::int64_t, std::int64_t)>& value);

// Of a slice of a segment: where its phi is 0, else half way between voxels inside and outside. None where it
// has no voxel.
std::vector<Contour> contours_of(const Segment& segment, const Geometry& geometry, std::int64_t k);

// In voxels; holes of a contour taken off.
double signed_area(const Contour& contour);

}  // namespace tidemark::imaging
