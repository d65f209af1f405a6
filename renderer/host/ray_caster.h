// Rays through the volume: the processor's side of resources/shaders/render/volume.frag. The surface is found
// to a fraction of a voxel in phi's resident pages; pages that show nothing are crossed in one stride.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <optional>

#include "renderer/host/page_kinds.h"
#include "renderer/host/ray_spans.h"
#include "renderer/host/shade_pieces.h"
#include "renderer/host/speed_terms.h"
#include "renderer/renderer.h"

namespace tidemark::renderer {

inline constexpr float kNever = 1e9F;        // beyond the end of every ray
inline constexpr float kJustBehind = 1e-3F;  // voxels along a ray: what is nearer than that is the same place

// For one picture of a view that is resolved(). Several threads may cast rays at once.
class RayCaster {
 public:
  // The scene outlives it and stays as it is.
  RayCaster(HostScene& scene, const VolumeView& view, PictureSize size);

  // The colour of a pixel, 0 to 1.
  [[nodiscard]] glm::vec3 colour(std::int64_t x, std::int64_t y) const;
  // The first thing that the ray through a place of the picture meets, in pixels from its top left.
  [[nodiscard]] std::optional<Hit> pick(glm::dvec2 pixel) const;

 private:
  // A ray on its way. A unit of t is a voxel.
  struct Ray {
    glm::vec3 start{0.0F};        // voxel coordinates
    glm::vec2 whole{0.0F};        // where it enters and leaves the volume
    glm::vec2 for_surface{0.0F};  // the parts of it in which they may show
    glm::vec2 for_source{0.0F};
    float cut = 0.0F;     // where the clip plane's picture is
    float jitter = 1.0F;  // of the first sample, in steps
    float t = 0.0F;
    bool inside = false;     // of the surface, at t
    glm::vec4 result{0.0F};  // premultiplied, front to back
    bool picks = false;
    std::optional<Hit> picked;

    // Labels: how far they have been looked at, the one there, where the next one begins or ends, and which.
    float label_t = 0.0F;
    int label_there = 0;
    float label_border = 0.0F;
    int label_met = 0;
    bool label_on_face = false;  // of the volume

    [[nodiscard]] bool is_opaque() const { return result.a >= kOpaque; }
    void add(glm::vec3 colour, float opacity) {
      result += (1.0F - result.a) * glm::vec4(colour * opacity, opacity);
    }
  };
  // A page on a ray's way, and where the ray leaves it: t of its far face along each axis, and the first of
  // them.
  struct Page {
    glm::ivec3 at{0};
    int number = 0;
    glm::vec3 faces{0.0F};
    float end = 0.0F;
  };
  // A piece of the ray in which the surface is: its ends and phi there.
  struct Piece {
    bool found = false;
    float a = 0.0F, b = 0.0F;
    float phi_a = 0.0F, phi_b = 0.0F;
  };

  void set_up_source();
  void set_up_light();
  // In that part of it in which the picture shows anything there.
  [[nodiscard]] Ray begin(glm::vec2 view_position, glm::vec2 span) const;
  // From where to where the ray is in a box.
  [[nodiscard]] glm::vec2 within(const Ray& ray, glm::vec3 low, glm::vec3 high) const;
  void clip(Ray& ray) const;
  void cast(Ray& ray) const;
  [[nodiscard]] glm::vec3 on(const Ray& ray, float t) const { return ray.start + t * direction_; }
  // t of the far face along each axis of a cube of that many pages a side, from `page` on.
  [[nodiscard]] glm::vec3 far_faces(const Ray& ray, glm::ivec3 page, int pages) const;
  // The page that the ray is in just behind t.
  [[nodiscard]] Page enter(const Ray& ray, float t) const;
  // The same from a page that is not behind it: face by face (Amanatides and Woo, "A Fast Voxel Traversal
  // Algorithm for Ray Tracing", Eurographics 1987).
  void follow(const Ray& ray, float t, Page& page) const;
  // The end of the empty pages around `page`.
  [[nodiscard]] float skip(const Ray& ray, const Page& page) const;

  [[nodiscard]] Piece march(Ray& ray, float stop) const;
  [[nodiscard]] Piece march_to_surface(Ray& ray, float stop) const;
  [[nodiscard]] Piece march_through_source(Ray& ray, float stop) const;
  void march_evenly(Ray& ray, float end, float step, float& first, Pieces& pieces) const;
  [[nodiscard]] Piece march_with_phi(Ray& ray, float end, bool source, float& first, Pieces& pieces) const;
  // The ray goes on to `end`, with phi there; the source shows on the way.
  void add_piece(Ray& ray, float end, float phi, Pieces& pieces) const;
  // Nothing shows on the way.
  void leap(Ray& ray, float end, Pieces& pieces) const;
  // The next piece begins with this phi.
  void set_phi(Ray& ray, float phi, Pieces& pieces) const;
  void shade(Ray& ray, Pieces& pieces) const;
  [[nodiscard]] float crossing(const Ray& ray, Piece piece) const;

  void begin_labels(Ray& ray) const;
  void find_label(Ray& ray, float stop) const;
  void meet_label(Ray& ray) const;
  [[nodiscard]] bool surface_is_at(glm::vec3 p) const;

  [[nodiscard]] glm::vec3 face_at(glm::vec3 p) const;
  [[nodiscard]] glm::vec3 lit(glm::vec3 colour, glm::vec3 slope, float open) const;
  [[nodiscard]] float openness(glm::vec3 p, glm::vec3 outward) const;
  [[nodiscard]] glm::vec3 taught_colour(glm::vec3 p) const;
  [[nodiscard]] glm::vec4 material_of_surface(glm::vec3 p) const;
  void meet_surface(Ray& ray, float at, glm::vec3 rise) const;
  void meet_clip_plane(Ray& ray) const;
  void pick_at(Ray& ray, Hit::Kind kind, glm::vec3 p) const;

  HostScene& scene_;
  const VolumeView& view_;
  PictureSize size_;
  ShadePieces shade_pieces_;
  PieceScene pieces_;
  SpeedTerms terms_;
  const MapSamples* change_ = nullptr;
  bool shows_source_;
  bool needs_phi_;
  bool shows_labels_;
  glm::vec3 volume_;   // voxels
  glm::vec3 spacing_;  // mm
  glm::mat4 voxel_from_view_;
  glm::vec3 direction_;  // of all rays, in voxels; length 1
  float mm_;             // a unit of t
  float step_;
  float longest_together_;  // voxels that pieces may span which are shaded together
  PageKinds kinds_;
  RaySpans spans_;
  glm::vec3 inverse_{0.0F};
  glm::ivec3 page_step_{1};    // along each axis, to the next page
  glm::ivec3 number_step_{1};  // of its number
  glm::vec3 viewer_{0.0F};     // unit vector to the viewer, in mm along the voxel axes
  float pixel_mm_ = 1.0F;
  std::optional<VoxelPlane> plane_;
};

}  // namespace tidemark::renderer
