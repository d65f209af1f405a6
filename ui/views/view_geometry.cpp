#include "ui/views/view_geometry.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace tidemark::ui {
namespace {

double aspect_of(QSizeF size) {
  return size.height() > 0.0 ? size.width() / size.height() : 1.0;
}

QPointF position_on(QSizeF size, double mm_per_pixel, double right_mm, double up_mm) {
  return {0.5 * size.width() + right_mm / mm_per_pixel, 0.5 * size.height() - up_mm / mm_per_pixel};
}

}  // namespace

SliceScreen::SliceScreen(const renderer::SliceView& view, QSizeF size, const Geometry& geometry)
    : orientation_(view.orientation), size_(size) {
  const glm::dvec3 middle = renderer::middle_of(geometry);
  const glm::dvec3 into = orientation_.into();
  centre_mm_ = middle + into * glm::dot(view.position_mm - middle, into) +
               orientation_.right * view.pan_mm.x + orientation_.up * view.pan_mm.y;
  mm_per_pixel_ = 2.0 * renderer::slice_half_height_mm(geometry, orientation_, view.zoom, aspect_of(size)) /
                  std::max(size.height(), 1.0);
}

glm::dvec3 SliceScreen::patient_at(QPointF position) const {
  return centre_mm_ + orientation_.right * (mm_per_pixel_ * (position.x() - 0.5 * size_.width())) -
         orientation_.up * (mm_per_pixel_ * (position.y() - 0.5 * size_.height()));
}

QPointF SliceScreen::position_of(glm::dvec3 patient_mm) const {
  const glm::dvec3 d = patient_mm - centre_mm_;
  return position_on(size_, mm_per_pixel_, glm::dot(d, orientation_.right), glm::dot(d, orientation_.up));
}

renderer::SliceOrientation acquired_plane(const Geometry& geometry) {
  const renderer::SliceOrientation standard = renderer::oblique(geometry.direction[2]);
  const glm::dvec3 row = geometry.direction[0];
  const glm::dvec3 column = geometry.direction[1];
  const bool is_turned = std::abs(glm::dot(row, standard.right)) < std::abs(glm::dot(row, standard.up));
  const auto towards = [](glm::dvec3 axis, glm::dvec3 wanted) {
    return glm::dot(axis, wanted) < 0.0 ? -axis : axis;
  };
  return {towards(is_turned ? column : row, standard.right), towards(is_turned ? row : column, standard.up)};
}

std::optional<std::int64_t> acquired_slice(const Geometry& geometry,
                                           const renderer::SliceOrientation& orientation,
                                           glm::dvec3 patient_mm) {
  constexpr double kParallel = 1.0 - 1e-6;  // within a twelfth of a degree
  if (std::abs(glm::dot(orientation.into(), geometry.direction[2])) < kParallel) return std::nullopt;
  const std::int64_t slice = std::llround(geometry.to_voxel(patient_mm).z);
  if (slice < 0 || slice >= geometry.size.z) return std::nullopt;
  return slice;
}

VolumeScreen::VolumeScreen(const renderer::Camera& camera, QSizeF size, const Geometry& geometry)
    : right_(camera.right()),
      up_(camera.up()),
      into_(glm::cross(up_, right_)),
      centre_mm_(camera.focus_mm.value_or(renderer::middle_of(geometry))),
      size_(size),
      mm_per_pixel_(2.0 * camera.half_height_mm(geometry, aspect_of(size)) / std::max(size.height(), 1.0)) {}

VolumeScreen::Ray VolumeScreen::ray_at(QPointF position) const {
  return {centre_mm_ + right_ * (mm_per_pixel_ * (position.x() - 0.5 * size_.width())) -
              up_ * (mm_per_pixel_ * (position.y() - 0.5 * size_.height())),
          into_};
}

QPointF VolumeScreen::position_of(glm::dvec3 patient_mm) const {
  const glm::dvec3 d = patient_mm - centre_mm_;
  return position_on(size_, mm_per_pixel_, glm::dot(d, right_), glm::dot(d, up_));
}

std::optional<glm::dvec3> VolumeScreen::on_plane(QPointF position, glm::dvec3 normal,
                                                 double offset_mm) const {
  constexpr double kSteepest = 0.02;  // sine of the angle below which a plane is seen from its edge
  const Ray ray = ray_at(position);
  const double slope = glm::dot(ray.direction, normal);
  if (std::abs(slope) < kSteepest) return std::nullopt;
  return ray.origin_mm + ray.direction * ((offset_mm - glm::dot(ray.origin_mm, normal)) / slope);
}

std::array<glm::dvec3, 8> corners_of_box(const Geometry& geometry) {
  std::array<glm::dvec3, 8> corners;
  for (std::size_t corner = 0; corner < corners.size(); ++corner) {
    glm::dvec3 voxel;
    for (int axis = 0; axis < 3; ++axis) {
      voxel[axis] = (corner >> axis & 1U) != 0 ? static_cast<double>(geometry.size[axis]) - 0.5 : -0.5;
    }
    corners[corner] = geometry.to_patient(voxel);
  }
  return corners;
}

std::vector<glm::dvec3> cut_of_box(const Geometry& geometry, const renderer::ClipPlane& plane) {
  const std::array<glm::dvec3, 8> corners = corners_of_box(geometry);
  std::vector<glm::dvec3> points;
  for (int corner = 0; corner < 8; ++corner) {
    for (int axis = 0; axis < 3; ++axis) {
      const int other = corner | 1 << axis;
      if (other == corner) continue;
      const double a = glm::dot(corners[static_cast<std::size_t>(corner)], plane.normal) - plane.offset_mm;
      const double b = glm::dot(corners[static_cast<std::size_t>(other)], plane.normal) - plane.offset_mm;
      if ((a < 0.0) == (b < 0.0)) continue;
      points.push_back(glm::mix(corners[static_cast<std::size_t>(corner)],
                                corners[static_cast<std::size_t>(other)], a / (a - b)));
    }
  }
  if (points.size() < 3) return {};
  glm::dvec3 middle(0.0);
  for (const glm::dvec3& point : points) middle += point / static_cast<double>(points.size());
  const glm::dvec3 x = glm::normalize(points.front() - middle);
  const glm::dvec3 y = glm::cross(plane.normal, x);
  const auto angle = [&](glm::dvec3 p) {
    return std::atan2(glm::dot(p - middle, y), glm::dot(p - middle, x));
  };
  std::sort(points.begin(), points.end(), [&](glm::dvec3 p, glm::dvec3 q) { return angle(p) < angle(q); });
  return points;
}

}  // namespace tidemark::ui
