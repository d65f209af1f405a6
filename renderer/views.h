// The views: what a picture shows, and how.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "core/volume.h"
#include "renderer/camera.h"
#include "renderer/transfer_function.h"

namespace tidemark::renderer {

// Everything in the patient where normal . p > offset is hidden, and the plane shows the source and, in
// yellow, the surface's cut. LPS, mm; the normal has length 1.
struct ClipPlane {
  glm::dvec3 normal{0.0, 1.0, 0.0};
  double offset_mm = 0.0;
  bool clips_source = true;
  bool clips_surface = true;
  bool picture = true;

  bool operator==(const ClipPlane&) const = default;
};

// Blinn-Phong. The shares of ambient and diffuse light make up the colour; specular light is white.
struct Lighting {
  double ambient = 0.22;
  double diffuse = 0.78;
  double specular = 0.25;
  double shininess = 40.0;
  std::optional<glm::dvec3> from;  // unit vector to the light in the patient (LPS); none: at the viewer
  double occlusion = 0.0;          // how much of the light hollows of the surface lose, 0 to 1

  bool operator==(const Lighting&) const = default;
};

// Numbered as in resources/shaders/render.
enum class Region { everywhere, inside, outside, tinted };  // tinted: everywhere, with the inside coloured
// doubt: the entropy of the probability that a learned D comes from.
enum class SpeedTerm { total, data, curvature, rescaling, doubt };
// change: as VolumeView::change says; nobody asks for it by name.
enum class SurfaceColouring { plain, total_speed, data, curvature_term, rescaling, curvature, pages, change };
enum class SliceContent { source, speed, pages };

// The quality of a volume rendering.
struct Quality {
  double step_voxels = 1.0;    // along a ray
  bool fast_gradient = false;  // lights the source from differences to one side
  int round = 0;  // pictures of other rounds have their rays and samples at other places, for taking means
  bool skip_empty = true;  // false only to measure the gain

  bool operator==(const Quality&) const = default;
};

// While something moves.
inline constexpr Quality kMovingQuality{1.5, true, 0, true};

// The mode of volume rendering: a ray for each pixel, or 2D slices that are reconstructed one after the
// other (paper section 5), which needs no 3D texture of the source.
enum class Mode { raycast, slices };

struct VolumeView {
  Mode mode = Mode::raycast;
  Camera camera;
  std::optional<TransferFunction> source;  // none: the surface alone
  bool surface = true;
  glm::vec4 surface_colour{0.93F, 0.72F, 0.45F, 1.0F};  // and opacity, unless `source` colours it
  SurfaceColouring colouring = SurfaceColouring::plain;
  bool change = false;  // a plain surface shows how far it has moved since it began from a mask
  Region region = Region::everywhere;  // where the source shows
  double label_opacity = 0.0;          // of the labels' borders
  std::optional<ClipPlane> clip;
  Lighting lighting;
  WindowLevel window;  // of the clip plane's picture
  glm::vec3 background{0.07F, 0.08F, 0.10F};
  Quality quality;

  bool operator==(const VolumeView&) const = default;
};

// Further images as they lie over a slice: red, green and blue times the opacity, and the opacity, row by row
// from the top left. It is stretched over the whole picture.
struct ImagesOver {
  std::int64_t width = 0;
  std::int64_t height = 0;
  std::vector<std::uint8_t> rgba;
};

struct SliceView {
  SliceOrientation orientation = kAxial;
  glm::dvec3 position_mm{0.0};  // a point of the slice (LPS)
  double zoom = 1.0;            // 1: the whole slice is seen
  glm::dvec2 pan_mm{0.0};       // the picture's middle, right and up of the volume's middle
  SliceContent content = SliceContent::source;
  SpeedTerm term = SpeedTerm::data;  // of the speed map
  WindowLevel window;
  bool nearest = false;  // voxels as squares
  bool surface = true;
  bool contours = false;  // lines where phi is -2, -1, 1 and 2, in units of the smallest spacing
  bool change = false;    // what the surface has won and lost since it began from a mask
  double line_pixels = 2.0;
  double label_opacity = 0.4;
  std::shared_ptr<const ImagesOver> images;  // over the source, below all else; null: none
  double images_from = 0.0;                  // the part of the picture's width left of which there are none
  glm::vec3 background{0.0F};

  bool operator==(const SliceView&) const = default;
};

}  // namespace tidemark::renderer
