// The geometry of views: where their pixels lie in the patient.
#pragma once

#include <QPointF>
#include <QSizeF>
#include <array>
#include <glm/mat4x4.hpp>
#include <optional>
#include <vector>

#include "renderer/views.h"

namespace tidemark::ui {

// A slice on the screen. Positions in logical pixels from the view's top left; patient coordinates LPS, mm.
class SliceScreen {
 public:
  SliceScreen(const renderer::SliceView& view, QSizeF size, const Geometry& geometry);

  [[nodiscard]] glm::dvec3 patient_at(QPointF position) const;
  [[nodiscard]] QPointF position_of(glm::dvec3 patient_mm) const;  // of its foot on the slice
  [[nodiscard]] double mm_per_pixel() const { return mm_per_pixel_; }

 private:
  renderer::SliceOrientation orientation_;
  glm::dvec3 centre_mm_;
  QSizeF size_;
  double mm_per_pixel_ = 1.0;
};

// A 3D view on the screen (parallel projection).
class VolumeScreen {
 public:
  VolumeScreen(const renderer::Camera& camera, QSizeF size, const Geometry& geometry);

  struct Ray {
    glm::dvec3 origin_mm;
    glm::dvec3 direction;  // unit, into the picture
  };
  [[nodiscard]] Ray ray_at(QPointF position) const;
  [[nodiscard]] QPointF position_of(glm::dvec3 patient_mm) const;
  // Where the ray through a position meets a plane; none when they are parallel.
  [[nodiscard]] std::optional<glm::dvec3> on_plane(QPointF position, glm::dvec3 normal,
                                                   double offset_mm) const;
  [[nodiscard]] double mm_per_pixel() const { return mm_per_pixel_; }
  [[nodiscard]] glm::dvec3 into() const { return into_; }

 private:
  glm::dvec3 right_;
  glm::dvec3 up_;
  glm::dvec3 into_;
  glm::dvec3 centre_mm_;
  QSizeF size_;
  double mm_per_pixel_ = 1.0;
};

// The plane in which the slices were acquired, turned as the standard plane that it is nearest to; rows and
// columns of the images are level.
renderer::SliceOrientation acquired_plane(const Geometry& geometry);
// The slice along k (from 0) that an orientation shows at a place. None where the orientation looks along
// another plane, or the place is beside the volume.
std::optional<std::int64_t> acquired_slice(const Geometry& geometry,
                                           const renderer::SliceOrientation& orientation,
                                           glm::dvec3 patient_mm);

// The corners of the volume's box (patient mm), by bits: 1 at the far side of i, 2 of j, 4 of k. They are
// half a voxel outside the outermost centres.
std::array<glm::dvec3, 8> corners_of_box(const Geometry& geometry);

// The polygon in which a plane cuts the volume's box (patient mm), in order; empty when it does not.
std::vector<glm::dvec3> cut_of_box(const Geometry& geometry, const renderer::ClipPlane& plane);

}  // namespace tidemark::ui
