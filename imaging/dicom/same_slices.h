// Equality from slice to slice, but for rounding in files.
#pragma once

#include "imaging/dicom/slice_header.h"

namespace tidemark::imaging {

// The most kinds of images in one volume; beyond that kinds are not compared.
inline constexpr std::size_t kMostKinds = 256;

[[nodiscard]] bool same_size(const SliceHeader& a, const SliceHeader& b);
// Of slices that have an orientation.
[[nodiscard]] bool same_orientation(const SliceHeader& a, const SliceHeader& b);
// Of slices that have a pixel spacing.
[[nodiscard]] bool same_spacing(const SliceHeader& a, const SliceHeader& b);

// Whether places so far apart along the normal (mm) are one.
[[nodiscard]] bool is_same_place(double distance);

// Whether row and column are two perpendicular unit vectors.
[[nodiscard]] bool is_orthonormal(const std::array<glm::dvec3, 2>& orientation);

}  // namespace tidemark::imaging
