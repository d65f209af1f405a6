// Where a picture is taken from.
#pragma once

#include <glm/mat4x4.hpp>

#include "core/geometry.h"

namespace tidemark {

// Turns around the middle of a volume. Azimuth 0 and elevation 0 look at the patient from the front, the head
// up; azimuth turns the viewer towards the patient's left, elevation towards the head. Degrees.
struct Camera {
  double azimuth = 0.0;
  double elevation = 0.0;
  double zoom = 1.0;  // 1: the whole volume is in view from every side

  // From the view (x and y in -1..1, z from -1 at the front to 1 at the back) to voxel coordinates, without
  // perspective. `aspect`: the picture's width by its height.
  [[nodiscard]] glm::dmat4 voxel_from_view(const Geometry& geometry, double aspect) const;
};

enum class SlicePlane { axial, coronal, sagittal };

// The same for a slice through `position_mm` in the patient, with the radiological convention: the patient's
// right on the left of axial and coronal pictures, anterior on the left of sagittal ones. The slice fills the
// view at zoom 1, and a pixel is a square in the patient whatever the spacing.
glm::dmat4 slice_from_view(const Geometry& geometry, SlicePlane plane, glm::dvec3 position_mm, double zoom,
                           double aspect);

// The middle of the volume, in the patient.
glm::dvec3 middle_of(const Geometry& geometry);

}  // namespace tidemark
