// The camera: where a picture is taken from.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "core/geometry.h"

namespace tidemark::renderer {

// A box in the patient (LPS, mm).
struct Box {
  glm::dvec3 low{0.0};
  glm::dvec3 high{0.0};
};

// Turns around a point, without perspective. Azimuth 0 and elevation 0 look at the patient from the front,
// the head up; azimuth turns the viewer towards the patient's left, elevation towards the head. Degrees.
struct Camera {
  double azimuth = 0.0;
  double elevation = 0.0;
  double zoom = 1.0;                                  // 1: the whole volume fits, seen from this side
  std::optional<glm::dvec3> focus_mm = std::nullopt;  // the picture's middle; none: the volume's middle

  bool operator==(const Camera&) const = default;

  // Unit vectors in the patient: to the right and up in the picture.
  [[nodiscard]] glm::dvec3 right() const;
  [[nodiscard]] glm::dvec3 up() const;
  // From the view (x and y in -1..1, z from -1 at the front to 1 at the back) to voxel coordinates.
  [[nodiscard]] glm::dmat4 voxel_from_view(const Geometry& geometry, double aspect) const;
  // Half the picture's height, in mm.
  [[nodiscard]] double half_height_mm(const Geometry& geometry, double aspect) const;
  // Looks from another side, at the same scale.
  [[nodiscard]] Camera turned_to(double new_azimuth, double new_elevation, const Geometry& geometry,
                                 double aspect) const;
  // Looks from the same side at a box, so that it fills the picture.
  [[nodiscard]] Camera on(const Box& box, const Geometry& geometry, double aspect) const;
  // Whether all of a box is in the picture.
  [[nodiscard]] bool sees(const Box& box, const Geometry& geometry, double aspect) const;
};

// The orientation of a slice in the patient: unit vectors (LPS) to the right and up in its picture.
struct SliceOrientation {
  glm::dvec3 right{1.0, 0.0, 0.0};
  glm::dvec3 up{0.0, -1.0, 0.0};

  bool operator==(const SliceOrientation&) const = default;

  // From the viewer into the picture.
  [[nodiscard]] glm::dvec3 into() const;
};

// The radiological convention: the patient's right on the left of axial and coronal pictures, anterior on the
// left of sagittal ones.
inline constexpr SliceOrientation kAxial{{1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}};
inline constexpr SliceOrientation kCoronal{{1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
inline constexpr SliceOrientation kSagittal{{0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
// Across `normal`, turned as the one of the three that it is nearest to. The normal must not be 0.
SliceOrientation oblique(glm::dvec3 normal);

// From the view (x and y in -1..1) of a slice through `position_mm` to voxel coordinates. The slice fills the
// view at zoom 1, and a pixel is a square in the patient whatever the spacing. `pan_mm` is the place of
// the view's middle, to the right and up of the volume's middle.
glm::dmat4 slice_from_view(const Geometry& geometry, const SliceOrientation& orientation,
                           glm::dvec3 position_mm, double zoom, glm::dvec2 pan_mm, double aspect);
double slice_half_height_mm(const Geometry& geometry, const SliceOrientation& orientation, double zoom,
                            double aspect);

// The middle of the volume, in the patient.
glm::dvec3 middle_of(const Geometry& geometry);

// The side of the patient to which a direction (LPS) points, as DICOM names it: L or R, P or A, H or F, and
// two or three of them by their share when it is oblique.
std::string orientation_letters(glm::dvec3 direction);

}  // namespace tidemark::renderer
