// What a ray meets: the surface, labels' borders, the picture on the clip plane. The processor's side of
// resources/shaders/render/events.glsl, shade.glsl and lighting.glsl.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "renderer/host/colours.h"
#include "renderer/host/ray_caster.h"

namespace tidemark::renderer {
namespace {

glm::ivec3 nearest_voxel(glm::vec3 p) {
  return glm::ivec3(glm::floor(p + 0.5F));
}

}  // namespace

// The normal of the volume's face that p is on, in mm.
glm::vec3 RayCaster::face_at(glm::vec3 p) const {
  const glm::vec3 to_face = glm::min(glm::abs(p + 0.5F), glm::abs(p - (volume_ - 0.5F)));
  const float nearest = std::min({to_face.x, to_face.y, to_face.z}) + 1e-3F;
  return glm::vec3(glm::lessThanEqual(to_face, glm::vec3(nearest)));
}

// Blinn-Phong, two-sided. `slope` in units a mm along the voxel axes; `open` is 1 where nothing keeps ambient
// light away.
glm::vec3 RayCaster::lit(glm::vec3 colour, glm::vec3 slope, float open) const {
  const float steepness = glm::length(slope);
  if (steepness < 1e-30F) return colour;
  const glm::vec3 normal = slope / steepness;
  const float facing = std::abs(glm::dot(normal, pieces_.light));
  const float mirrored = std::abs(glm::dot(normal, pieces_.half_way));
  const float gloss =
      pieces_.specular > 0.0F ? pieces_.specular * open * std::pow(mirrored, pieces_.shininess) : 0.0F;
  return colour * open * (pieces_.ambient + pieces_.diffuse * facing) + gloss;
}

// How open the surface is at p, from what phi is above it: it would be minus the distance above a plain.
float RayCaster::openness(glm::vec3 p, glm::vec3 outward) const {
  const float unit = std::min({spacing_.x, spacing_.y, spacing_.z});
  float hidden = 0.0F;
  for (int i = 1; i <= 3; ++i) {
    const float up = 0.25F * static_cast<float>(i) * scene_.phi.band();
    const float phi = scene_.phi.between(p + outward * (up * unit) / spacing_);
    hidden += std::clamp((up + phi) / up, 0.0F, 1.0F) / 3.0F;
  }
  return 1.0F - static_cast<float>(view_.lighting.occlusion) * hidden;
}

glm::vec3 RayCaster::taught_colour(glm::vec3 p) const {
  const glm::ivec3 voxel = glm::clamp(nearest_voxel(p), glm::ivec3(0), scene_.source.size() - 1);
  switch (view_.colouring) {
    case SurfaceColouring::change:
      return diverging(change_ != nullptr ? change_->between(p) : 0.0F);
    case SurfaceColouring::pages:
      return page_colour(scene_.phi.state(scene_.phi.page_number(scene_.phi.page_of(voxel))));
    case SurfaceColouring::curvature:
      return diverging(2.0F * terms_.between(SpeedTerm::curvature, p).curvature);
    default:
      break;
  }
  // Terms have the numbers of colourings, without plain.
  return diverging(terms_.between(static_cast<SpeedTerm>(static_cast<int>(view_.colouring) - 1), p).speed);
}

glm::vec4 RayCaster::material_of_surface(glm::vec3 p) const {
  if (!view_.source || view_.source->surface.empty()) return view_.surface_colour;
  const double intensity = static_cast<double>(scene_.source.between(p));
  const double distance =
      plane_ ? std::abs(plane_->offset - glm::dot(plane_->normal, glm::dvec3(p))) * plane_->mm : 0.0;
  glm::vec3 colour(0.0F);
  float opacity = 0.0F;
  for (const SurfacePrimitive& one : view_.source->surface) {
    const float share =
        static_cast<float>(one.opacity * one.intensity.at(intensity) * one.distance.at(distance));
    colour += share * one.colour;
    opacity += share;
  }
  return opacity > 0.0F ? glm::vec4(colour / opacity, std::min(opacity, 1.0F)) : glm::vec4(0.0F);
}

// `rise`: d phi / d voxel there.
void RayCaster::meet_surface(Ray& ray, float at, glm::vec3 rise) const {
  const glm::vec3 p = on(ray, at);
  const glm::vec4 material = material_of_surface(p);
  glm::vec3 colour(material);
  if (view_.colouring != SurfaceColouring::plain) {
    colour = taught_colour(p);
  } else if (shows_labels_) {
    // A label that ends where the surface is colours the surface, as it does in slices; its own border, which
    // is there to half a voxel, is not drawn.
    const glm::vec3 inward = 0.75F * rise / std::max(glm::length(rise), 1e-6F);
    const int label = scene_.labels.between(p + inward);
    if (label != 0 && scene_.labels.between(p - inward) != label) {
      colour = glm::mix(colour, scene_.labels.colour(label), static_cast<float>(view_.label_opacity));
    }
  }
  const glm::vec3 slope = rise / spacing_;
  const float open =
      view_.lighting.occlusion > 0.0 ? openness(p, -slope / std::max(glm::length(slope), 1e-6F)) : 1.0F;
  ray.add(lit(colour, slope, open), material.a);
  pick_at(ray, Hit::Kind::surface, p);
}

// The picture on the clip plane: the source in its window, the surface's cut as a line of constant width.
void RayCaster::meet_clip_plane(Ray& ray) const {
  const glm::vec3 p = on(ray, ray.cut);
  const float grey = (scene_.source.between(p) - static_cast<float>(view_.window.centre)) /
                         static_cast<float>(view_.window.width) +
                     0.5F;
  glm::vec3 colour(std::clamp(grey, 0.0F, 1.0F));
  if (shows_labels_) {
    const int label = scene_.labels.at(nearest_voxel(p));
    if (label != 0)
      colour = glm::mix(colour, scene_.labels.colour(label), static_cast<float>(view_.label_opacity));
  }
  if (view_.surface) {
    const float phi = scene_.phi.between(p);
    const glm::vec3 normal = glm::normalize(glm::vec3(plane_->normal) / spacing_);
    const glm::vec3 slope = scene_.phi.slope(p) / spacing_;
    const float steepness = glm::length(slope - normal * glm::dot(slope, normal));
    const float pixels = std::abs(phi) / std::max(steepness * pixel_mm_, 1e-6F);
    if (std::abs(phi) < scene_.phi.band()) {
      colour = glm::mix(kOutlineYellow, colour, glm::smoothstep(0.5F, 1.5F, pixels));
    }
  }
  ray.add(colour, 1.0F);
  pick_at(ray, Hit::Kind::clip_plane, p);
}

void RayCaster::begin_labels(Ray& ray) const {
  ray.label_border = kNever;
  if (ray.for_surface.x > ray.for_surface.y) return;
  ray.label_t = ray.for_surface.x;
  ray.label_there = scene_.labels.between(on(ray, ray.label_t));
  // Where it meets the volume's border a label is closed.
  ray.label_on_face = ray.label_there != 0 && ray.label_t <= ray.whole.x + kJustBehind;
  ray.label_border = ray.whole.x;
  ray.label_met = ray.label_there;
  if (!ray.label_on_face) find_label(ray, ray.for_surface.y - 2e-3F);
}

// Finds the next border from label_t on, until `stop`.
void RayCaster::find_label(Ray& ray, float stop) const {
  const LabelSamples& labels = scene_.labels;
  int next = ray.label_there;
  float before = ray.label_t;
  Page page = enter(ray, ray.label_t);
  while (ray.label_t < stop && next == ray.label_there) {
    follow(ray, ray.label_t, page);
    const float leave = std::min(page.end, stop);
    if (view_.quality.skip_empty &&
        labels.pages().pages()[static_cast<std::size_t>(page.number)] == ray.label_there) {
      ray.label_t = page.end;
      continue;
    }
    while (ray.label_t < leave && next == ray.label_there) {
      before = ray.label_t;
      ray.label_t = std::min(ray.label_t + step_, leave);
      next = labels.between(on(ray, ray.label_t));
    }
  }
  float after = ray.label_t;
  for (int i = 0; i < 5 && next != ray.label_there; ++i) {
    const float middle = 0.5F * (before + after);
    (labels.between(on(ray, middle)) != ray.label_there ? after : before) = middle;
  }
  ray.label_border = next != ray.label_there ? after : kNever;
  ray.label_met = next != 0 ? next : ray.label_there;
  ray.label_there = next;
}

bool RayCaster::surface_is_at(glm::vec3 p) const {
  if (!view_.surface || view_.surface_colour.a <= 0.0F) return false;
  const glm::vec3 slope = glm::abs(scene_.phi.slope(p));
  return std::abs(scene_.phi.between(p)) < std::max(0.75F * std::max({slope.x, slope.y, slope.z}), 0.5F);
}

void RayCaster::meet_label(Ray& ray) const {
  const glm::vec3 p = on(ray, ray.label_border);
  const glm::vec3 slope = ray.label_on_face ? face_at(p) * spacing_ : scene_.labels.slope(ray.label_met, p);
  ray.add(lit(scene_.labels.colour(ray.label_met), slope / spacing_, 1.0F),
          surface_is_at(p) ? 0.0F : static_cast<float>(view_.label_opacity));
  pick_at(ray, Hit::Kind::surface, p);
  ray.label_on_face = false;
  find_label(ray, ray.for_surface.y - 2e-3F);
}

}  // namespace tidemark::renderer
