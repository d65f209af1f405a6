#include "renderer/camera.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace tidemark {
namespace {

// Maps view coordinates to the patient's (mm) by the view's axes, each half as long as the view is, and then
// to voxels.
glm::dmat4 voxel_from_axes(const Geometry& geometry, glm::dvec3 middle_mm, const glm::dmat3& axes) {
  const glm::dvec3 origin = geometry.to_voxel(middle_mm);
  glm::dmat4 matrix(1.0);
  for (int axis = 0; axis < 3; ++axis) {
    matrix[axis] = glm::dvec4(geometry.to_voxel(middle_mm + axes[axis]) - origin, 0.0);
  }
  matrix[3] = glm::dvec4(origin, 1.0);
  return matrix;
}

// Half the extent of the volume along a unit vector of the patient, in mm.
double half_extent(const Geometry& geometry, glm::dvec3 along) {
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    sum += std::abs(glm::dot(along, geometry.direction[axis])) * geometry.spacing_mm[axis] *
           static_cast<double>(geometry.size[axis]);
  }
  return 0.5 * sum;
}

}  // namespace

glm::dvec3 middle_of(const Geometry& geometry) {
  return geometry.to_patient(0.5 * glm::dvec3(geometry.size - Index3(1)));
}

glm::dmat4 Camera::voxel_from_view(const Geometry& geometry, double aspect) const {
  const double a = glm::radians(azimuth);
  const double e = glm::radians(elevation);
  // From the viewer into the picture; LPS: +y is posterior, +x the patient's left, +z the head.
  const glm::dvec3 into(-std::sin(a) * std::cos(e), std::cos(a) * std::cos(e), -std::sin(e));
  const glm::dvec3 right(std::cos(a), std::sin(a), 0.0);
  const glm::dvec3 up = glm::cross(right, into);
  constexpr double kMargin = 1.04;
  const double depth = 0.5 * glm::length(glm::dvec3(geometry.size) * geometry.spacing_mm);
  const double half =
      kMargin * std::max(half_extent(geometry, right) / aspect, half_extent(geometry, up)) / zoom;
  return voxel_from_axes(geometry, middle_of(geometry), {right * half * aspect, up * half, into * depth});
}

glm::dmat4 slice_from_view(const Geometry& geometry, SlicePlane plane, glm::dvec3 position_mm, double zoom,
                           double aspect) {
  glm::dvec3 right(1.0, 0.0, 0.0);
  glm::dvec3 up(0.0, 0.0, 1.0);
  if (plane == SlicePlane::axial) up = {0.0, -1.0, 0.0};
  if (plane == SlicePlane::sagittal) right = {0.0, 1.0, 0.0};
  const glm::dvec3 into = glm::cross(up, right);
  const double half =
      std::max(half_extent(geometry, right) / std::max(aspect, 1e-6), half_extent(geometry, up)) / zoom;
  // The slice's own position along its normal; the volume's middle across it.
  const glm::dvec3 middle = middle_of(geometry);
  const glm::dvec3 centre = middle + into * glm::dot(position_mm - middle, into);
  return voxel_from_axes(geometry, centre, {right * half * aspect, up * half, into});
}

}  // namespace tidemark
