#include "renderer/camera.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace tidemark::renderer {
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

double half_extent(const Box& box, glm::dvec3 along) {
  return 0.5 * glm::dot(glm::abs(along), box.high - box.low);
}

constexpr double kMargin = 1.04;

}  // namespace

glm::dvec3 middle_of(const Geometry& geometry) {
  return geometry.to_patient(0.5 * glm::dvec3(geometry.size - Index3(1)));
}

glm::dvec3 Camera::right() const {
  const double a = glm::radians(azimuth);
  return {std::cos(a), std::sin(a), 0.0};
}

// LPS: +y is posterior, +x the patient's left, +z the head.
glm::dvec3 Camera::up() const {
  const double a = glm::radians(azimuth);
  const double e = glm::radians(elevation);
  const glm::dvec3 into(-std::sin(a) * std::cos(e), std::cos(a) * std::cos(e), -std::sin(e));
  return glm::cross(right(), into);
}

double Camera::half_height_mm(const Geometry& geometry, double aspect) const {
  return kMargin * std::max(half_extent(geometry, right()) / aspect, half_extent(geometry, up())) / zoom;
}

glm::dmat4 Camera::voxel_from_view(const Geometry& geometry, double aspect) const {
  const glm::dvec3 into = glm::cross(up(), right());
  const glm::dvec3 focus = focus_mm.value_or(middle_of(geometry));
  // Far enough to both sides for all of the volume.
  const double depth = 0.5 * glm::length(glm::dvec3(geometry.size) * geometry.spacing_mm) +
                       std::abs(glm::dot(focus - middle_of(geometry), into));
  const double half = half_height_mm(geometry, aspect);
  return voxel_from_axes(geometry, focus, {right() * half * aspect, up() * half, into * depth});
}

Camera Camera::turned_to(double new_azimuth, double new_elevation, const Geometry& geometry,
                         double aspect) const {
  Camera camera = *this;
  camera.azimuth = new_azimuth;
  camera.elevation = new_elevation;
  camera.zoom *= camera.half_height_mm(geometry, aspect) / half_height_mm(geometry, aspect);
  return camera;
}

Camera Camera::on(const Box& box, const Geometry& geometry, double aspect) const {
  Camera camera = *this;
  camera.focus_mm = 0.5 * (box.low + box.high);
  camera.zoom = 1.0;
  const double needed = kMargin * std::max(half_extent(box, right()) / aspect, half_extent(box, up()));
  camera.zoom = needed > 0.0 ? camera.half_height_mm(geometry, aspect) / needed : 1.0;
  return camera;
}

bool Camera::sees(const Box& box, const Geometry& geometry, double aspect) const {
  const double half = half_height_mm(geometry, aspect);
  const glm::dvec3 off = 0.5 * (box.low + box.high) - focus_mm.value_or(middle_of(geometry));
  return std::abs(glm::dot(off, right())) + half_extent(box, right()) <= half * aspect &&
         std::abs(glm::dot(off, up())) + half_extent(box, up()) <= half;
}

glm::dvec3 SliceOrientation::into() const {
  return glm::cross(up, right);
}

SliceOrientation oblique(glm::dvec3 normal) {
  const SliceOrientation* nearest = &kAxial;
  for (const SliceOrientation* one : {&kAxial, &kCoronal, &kSagittal}) {
    if (std::abs(glm::dot(one->into(), normal)) > std::abs(glm::dot(nearest->into(), normal))) nearest = one;
  }
  glm::dvec3 into = glm::normalize(normal);
  if (glm::dot(into, nearest->into()) < 0.0) into = -into;
  const glm::dvec3 up = glm::normalize(nearest->up - into * glm::dot(nearest->up, into));
  return {glm::cross(into, up), up};
}

double slice_half_height_mm(const Geometry& geometry, const SliceOrientation& orientation, double zoom,
                            double aspect) {
  return std::max(half_extent(geometry, orientation.right) / std::max(aspect, 1e-6),
                  half_extent(geometry, orientation.up)) /
         zoom;
}

glm::dmat4 slice_from_view(const Geometry& geometry, const SliceOrientation& orientation,
                           glm::dvec3 position_mm, double zoom, glm::dvec2 pan_mm, double aspect) {
  const glm::dvec3 into = orientation.into();
  const double half = slice_half_height_mm(geometry, orientation, zoom, aspect);
  // The slice's own position along its normal; the volume's middle across it.
  const glm::dvec3 middle = middle_of(geometry);
  const glm::dvec3 centre = middle + into * glm::dot(position_mm - middle, into) +
                            orientation.right * pan_mm.x + orientation.up * pan_mm.y;
  return voxel_from_axes(geometry, centre, {orientation.right * half * aspect, orientation.up * half, into});
}

std::string orientation_letters(glm::dvec3 direction) {
  // Shares below this (11 degrees) are not worth a letter.
  constexpr double kLeastShare = 0.2;
  constexpr std::array<std::array<char, 2>, 3> kLetters{{{'R', 'L'}, {'A', 'P'}, {'F', 'H'}}};
  std::array<int, 3> axes{0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(),
                   [&](int a, int b) { return std::abs(direction[a]) > std::abs(direction[b]); });
  const double length = glm::length(direction);
  std::string letters;
  for (const int axis : axes) {
    if (std::abs(direction[axis]) <= kLeastShare * length) continue;
    letters += kLetters[static_cast<std::size_t>(axis)][direction[axis] > 0.0 ? 1 : 0];
  }
  return letters;
}

}  // namespace tidemark::renderer
