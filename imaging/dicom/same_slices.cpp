#include "imaging/dicom/same_slices.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace tidemark::imaging {
namespace {

// The largest difference of orientation and pixel spacing from slice to slice.
constexpr double kSameness = 1e-4;
// The largest deviation of the orientation from orthonormal.
constexpr double kOrthonormality = 1e-3;

bool is_same(glm::dvec3 a, glm::dvec3 b) {
  const glm::dvec3 difference = glm::abs(a - b);
  return std::max({difference.x, difference.y, difference.z}) <= kSameness;
}

}  // namespace

bool same_size(const SliceHeader& a, const SliceHeader& b) {
  return a.rows == b.rows && a.columns == b.columns;
}

bool same_orientation(const SliceHeader& a, const SliceHeader& b) {
  return is_same((*a.orientation)[0], (*b.orientation)[0]) &&
         is_same((*a.orientation)[1], (*b.orientation)[1]);
}

bool same_spacing(const SliceHeader& a, const SliceHeader& b) {
  const glm::dvec2 difference = glm::abs(*a.pixel_spacing_mm - *b.pixel_spacing_mm);
  return difference.x <= kSameness * a.pixel_spacing_mm->x &&
         difference.y <= kSameness * a.pixel_spacing_mm->y;
}

bool is_same_place(double distance) {
  constexpr double kSamePlace = 0.01 + 1e-9;
  return std::abs(distance) <= kSamePlace;
}

bool is_orthonormal(const std::array<glm::dvec3, 2>& orientation) {
  const auto& [row, column] = orientation;
  return std::abs(glm::length(row) - 1.0) <= kOrthonormality &&
         std::abs(glm::length(column) - 1.0) <= kOrthonormality &&
         std::abs(glm::dot(row, column)) <= kOrthonormality;
}

}  // namespace tidemark::imaging
