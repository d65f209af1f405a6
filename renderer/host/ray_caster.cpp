#include "renderer/host/ray_caster.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

namespace tidemark::renderer {
namespace {

constexpr int kMostLayers = 64;  // of surface, labels and clip plane along a ray

float least(glm::vec3 v) {
  return std::min({v.x, v.y, v.z});
}

// Offsets without a pattern that the eye finds (interleaved gradient noise, Jimenez 2014).
float jitter(glm::vec2 pixel, int round) {
  const glm::vec2 p = pixel + 5.588238F * static_cast<float>(round);
  return std::max(glm::fract(52.9829189F * glm::fract(glm::dot(p, glm::vec2(0.06711056F, 0.00583715F)))),
                  0.05F);
}

}  // namespace

RayCaster::RayCaster(HostScene& scene, const VolumeView& view, PictureSize size)
    : scene_(scene),
      view_(view),
      size_(size),
      shade_pieces_(shade_pieces()),
      terms_{scene.phi, scene.source, scene.map(EvaluatedMap::speed), scene.tent(), scene.constants},
      change_(view.colouring == SurfaceColouring::change ? scene.map(EvaluatedMap::change) : nullptr),
      shows_source_(shows_source(view)),
      needs_phi_(needs_phi(view)),
      shows_labels_(scene.labels.pages().show_at(view.label_opacity)),
      volume_(scene.source.size()),
      spacing_(scene.geometry().spacing_mm),
      voxel_from_view_(voxel_from_view(view, scene.geometry(), size)),
      direction_(glm::normalize(glm::vec3(voxel_from_view_[2]))),
      mm_(glm::length(direction_ * spacing_)),
      step_(static_cast<float>(view.quality.step_voxels)),
      longest_together_(longest_together(scene.source.size())),
      kinds_(scene, view, step_ * mm_),
      spans_(kinds_, scene.phi.page_shape(), voxel_from_view_, size) {
  const Geometry& geometry = scene.geometry();
  pixel_mm_ = static_cast<float>(2.0 * view.camera.half_height_mm(geometry, size.aspect()) /
                                 static_cast<double>(size.height));
  for (int axis = 0; axis < 3; ++axis) {
    inverse_[axis] = 1.0F / (direction_[axis] == 0.0F ? 1e-9F : direction_[axis]);
    page_step_[axis] = inverse_[axis] > 0.0F ? 1 : -1;
    glm::ivec3 one(0);
    one[axis] = page_step_[axis];
    number_step_[axis] = scene.phi.page_number(one);
  }
  viewer_ = -direction_ * spacing_ / mm_;
  if (view.clip) plane_ = clip_plane_in_voxels(*view.clip, geometry);
  set_up_light();
  if (shows_source_) set_up_source();
}

void RayCaster::set_up_light() {
  const Lighting& light = view_.lighting;
  pieces_.ambient = static_cast<float>(light.ambient);
  pieces_.diffuse = static_cast<float>(light.diffuse);
  pieces_.specular = static_cast<float>(light.specular);
  pieces_.shininess = static_cast<float>(light.shininess);
  pieces_.least_mirrored = std::pow(1e-6F, 1.0F / std::max(pieces_.shininess, 1e-3F));
  pieces_.light = light.from ? glm::vec3(glm::transpose(scene_.geometry().direction) * *light.from) : viewer_;
  pieces_.half_way = glm::normalize(pieces_.light + viewer_);
}

void RayCaster::set_up_source() {
  const auto as_floats = [](const TransferFactor& factor) {
    return PieceScene::Factor{factor.kind, static_cast<float>(factor.start), static_cast<float>(factor.end)};
  };
  pieces_.source = &scene_.source;
  for (const SourcePrimitive& one : view_.source->source) {
    pieces_.primitives[static_cast<std::size_t>(pieces_.count++)] = {
        as_floats(one.value), as_floats(one.gradient), as_floats(one.phi), static_cast<float>(one.opacity),
        one.colour};
  }
  pieces_.fast_gradient = view_.quality.fast_gradient;
  pieces_.rays_are_sparse = pixel_mm_ > std::min({spacing_.x, spacing_.y, spacing_.z});
  pieces_.region = view_.region;
  pieces_.tint = glm::vec3(view_.surface_colour);
  pieces_.direction = direction_;
  pieces_.mm = mm_;
  pieces_.inverse_spacing = 1.0F / spacing_;
}

// Finds where the ray is in the volume, and the parts of that in which things may show.
RayCaster::Ray RayCaster::begin(glm::vec2 view_position, glm::vec2 span) const {
  Ray ray;
  ray.start = glm::vec3(voxel_from_view_ * glm::vec4(view_position, -1.0F, 1.0F));
  ray.whole = within(ray, glm::vec3(-0.5F), volume_ - 0.5F);
  clip(ray);
  for (glm::vec2* part : {&ray.for_surface, &ray.for_source}) {
    *part = {std::max(part->x, span.x), std::min(part->y, span.y)};
  }
  return ray;
}

glm::vec2 RayCaster::within(const Ray& ray, glm::vec3 low, glm::vec3 high) const {
  const glm::vec3 to_low = (low - ray.start) * inverse_;
  const glm::vec3 to_high = (high - ray.start) * inverse_;
  const glm::vec3 enter = glm::min(to_low, to_high);
  const glm::vec3 leave = glm::max(to_low, to_high);
  return {std::max({enter.x, enter.y, enter.z, 0.0F}), std::min({leave.x, leave.y, leave.z})};
}

void RayCaster::clip(Ray& ray) const {
  glm::vec2 left = ray.whole;
  ray.cut = kNever;
  if (plane_) {
    const glm::vec3 normal(plane_->normal);
    const float slope = glm::dot(normal, direction_);
    const float distance = static_cast<float>(plane_->offset) - glm::dot(normal, ray.start);
    const float meets = distance / (std::abs(slope) > 1e-6F ? slope : 1e-6F);
    if (std::abs(slope) <= 1e-6F && distance < 0.0F) left.y = left.x - 1.0F;  // nothing
    if (slope < -1e-6F) left.x = std::max(left.x, meets);
    if (slope > 1e-6F) left.y = std::min(left.y, meets);
    if (view_.clip->picture && std::abs(slope) > 1e-6F && meets >= ray.whole.x && meets < ray.whole.y) {
      ray.cut = meets;
    }
  }
  ray.for_surface = plane_ && view_.clip->clips_surface ? left : ray.whole;
  ray.for_source = plane_ && view_.clip->clips_source ? left : ray.whole;
}

glm::vec3 RayCaster::far_faces(const Ray& ray, glm::ivec3 page, int pages) const {
  const glm::vec3 shape(scene_.phi.page_shape());
  const glm::vec3 low = glm::vec3(page) * shape - 0.5F - ray.start;
  return glm::max(low * inverse_, (low + static_cast<float>(pages) * shape) * inverse_);
}

RayCaster::Page RayCaster::enter(const Ray& ray, float t) const {
  const glm::ivec3 voxel(glm::max(on(ray, t + kJustBehind) + 0.5F, glm::vec3(0.0F)));
  Page page;
  page.at = glm::min(scene_.phi.page_of(voxel), scene_.phi.page_grid() - 1);
  page.number = scene_.phi.page_number(page.at);
  page.faces = far_faces(ray, page.at, 1);
  page.end = std::max(least(page.faces), t + kJustBehind);
  return page;
}

void RayCaster::follow(const Ray& ray, float t, Page& page) const {
  while (page.end <= t + kJustBehind) {
    int axis = page.faces.y < page.faces.x ? 1 : 0;
    if (page.faces.z < page.faces[axis]) axis = 2;
    const int next = page.at[axis] + page_step_[axis];
    if (next < 0 || next >= scene_.phi.page_grid()[axis]) {  // on the volume's face
      page.end = t + 2.0F * kJustBehind;
      return;
    }
    page.at[axis] = next;
    page.number += number_step_[axis];
    const int far_face = (next + (page_step_[axis] > 0 ? 1 : 0)) * scene_.phi.page_shape()[axis];
    page.faces[axis] = (static_cast<float>(far_face) - 0.5F - ray.start[axis]) * inverse_[axis];
    page.end = least(page.faces);
  }
}

float RayCaster::skip(const Ray& ray, const Page& page) const {
  if (!kinds_.cube_is_empty(page.at)) return page.end;
  const glm::ivec3 cube = page.at / PageKinds::kSide * PageKinds::kSide;
  return std::max(least(far_faces(ray, cube, PageKinds::kSide)), page.end);
}

// The next piece of the ray in which the surface is, from t until `stop`, adding the source on the way.
RayCaster::Piece RayCaster::march(Ray& ray, float stop) const {
  if (shows_source_) return march_through_source(ray, stop);
  if (view_.surface) return march_to_surface(ray, stop);
  ray.t = std::max(ray.t, stop);
  return {};
}

// With the surface alone. Where phi is +-W the surface is some voxels away; elsewhere phi says how far, but
// may be twice as steep as a distance.
RayCaster::Piece RayCaster::march_to_surface(Ray& ray, float stop) const {
  const PhiPages& phi = scene_.phi;
  const float voxels_per_phi = std::min({spacing_.x, spacing_.y, spacing_.z}) / mm_;
  const float nearly_band = 0.98F * phi.band();
  float before = ray.t;
  Page page = enter(ray, ray.t);
  while (ray.t < stop) {
    // To where phi varies.
    while (ray.t < stop) {
      follow(ray, ray.t, page);
      const bool resident = (kinds_[page.number] & PageKinds::kPhi) != 0;
      if (!view_.quality.skip_empty) break;
      // Cut off instead of rounded down: the same, as the volume begins at -0.5.
      if (resident && std::abs(phi.at(glm::ivec3(on(ray, ray.t) + 0.5F))) < nearly_band) break;
      before = ray.t;
      ray.t = resident ? std::min(ray.t + 1.0F, page.end) : skip(ray, page);
    }
    // Step by step, while it does.
    float phi_a = phi.between(on(ray, ray.t));
    if (ray.t < stop && (phi_a > 0.0F) != ray.inside) {
      return {true, before, ray.t, ray.inside ? 1.0F : -1.0F, phi_a};  // in the last stride
    }
    while (ray.t < stop) {
      float next = ray.t + step_;
      if (view_.quality.skip_empty) next = std::max(next, ray.t + 0.5F * std::abs(phi_a) * voxels_per_phi);
      next = std::min(next, stop);
      const float phi_b = phi.between(on(ray, next));
      before = ray.t;
      ray.t = next;
      if ((phi_b > 0.0F) != ray.inside) return {true, before, next, phi_a, phi_b};
      phi_a = phi_b;
      if (view_.quality.skip_empty && std::abs(phi_b) > nearly_band) break;
    }
  }
  return {};
}

RayCaster::Piece RayCaster::march_through_source(Ray& ray, float stop) const {
  const PhiPages& phi = scene_.phi;
  Pieces pieces;
  pieces.start = ray.start;
  pieces.shows_from = ray.for_source.x;
  pieces.shows_to = ray.for_source.y;
  pieces.phi[0] = 0.0F;
  leap(ray, ray.t, pieces);
  float first = ray.jitter * step_;  // step of the ray; then 0
  Piece piece;
  Page page = enter(ray, ray.t);
  while (ray.t < stop && !piece.found && !ray.is_opaque()) {
    follow(ray, ray.t, page);
    const std::uint8_t kind = kinds_[page.number];
    if (kind == 0) {
      leap(ray, std::min(skip(ray, page), std::max(stop, ray.t)), pieces);
      continue;
    }
    if ((kind & PageKinds::kPhi) != 0) {
      const bool shows = (kind & PageKinds::kSource) != 0;
      piece = march_with_phi(ray, std::min(page.end, stop), shows, first, pieces);
      continue;
    }
    // All pages in which phi is the same.
    const bool inside = phi.is_inside(page.number);
    float end = page.end;
    while (end < stop) {
      follow(ray, end, page);
      if (kinds_[page.number] != kind || (needs_phi_ && phi.is_inside(page.number) != inside)) break;
      end = page.end;
    }
    if (needs_phi_) set_phi(ray, inside ? phi.band() : -phi.band(), pieces);
    march_evenly(ray, std::min(end, stop), PageKinds::stride(kind) * step_, first, pieces);
  }
  if (pieces.ends_with_gap()) --pieces.count;
  shade(ray, pieces);
  return piece;
}

void RayCaster::march_evenly(Ray& ray, float end, float step, float& first, Pieces& pieces) const {
  const float phi = pieces.phi[static_cast<std::size_t>(pieces.count)];
  while (ray.t < end && !ray.is_opaque()) {
    const float far_end = (pieces.count > 0 ? pieces.to[0] : ray.t) + longest_together_;
    const int room = Pieces::kMost - pieces.count;
    const int whole = std::min(room, static_cast<int>((std::min(end, far_end) - ray.t) / step));
    if (whole <= 1 || first > 0.0F || ray.picks) {
      const float next = ray.t + (first > 0.0F ? std::exchange(first, 0.0F) : step);
      add_piece(ray, std::min(next, end), phi, pieces);
      continue;
    }
    // All pieces that have room are added at once.
    const auto piece = static_cast<std::size_t>(pieces.count);
    for (std::size_t i = 0; i < static_cast<std::size_t>(whole); ++i) {
      pieces.from[piece + i] = ray.t + static_cast<float>(i) * step;
      pieces.to[piece + i] = ray.t + static_cast<float>(i + 1) * step;
      pieces.phi[piece + i + 1] = phi;
    }
    pieces.count += whole;
    ray.t += static_cast<float>(whole) * step;
    if (whole == room) shade(ray, pieces);
  }
}

// In one page, whose source may show.
RayCaster::Piece RayCaster::march_with_phi(Ray& ray, float end, bool source, float& first,
                                           Pieces& pieces) const {
  float phi = scene_.phi.between(on(ray, ray.t));
  set_phi(ray, phi, pieces);
  Piece piece;
  while (ray.t < end && !piece.found && !ray.is_opaque()) {
    float next = std::min(ray.t + (first > 0.0F ? std::exchange(first, 0.0F) : step_), end);
    float next_phi = scene_.phi.between(on(ray, next));
    if (view_.surface && (next_phi > 0.0F) != ray.inside) {
      piece = {true, ray.t, next, phi, next_phi};
      // Up to the surface; what is behind it comes after it.
      next = glm::mix(ray.t, next, std::clamp(phi / (phi - next_phi), 0.0F, 1.0F));
      next_phi = phi;
    }
    phi = next_phi;
    if (source) {
      add_piece(ray, next, phi, pieces);
    } else {
      leap(ray, next, pieces);
    }
  }
  return piece;
}

void RayCaster::add_piece(Ray& ray, float end, float phi, Pieces& pieces) const {
  const auto piece = static_cast<std::size_t>(pieces.count++);
  pieces.from[piece] = std::exchange(ray.t, end);
  pieces.to[piece] = end;
  pieces.phi[piece + 1] = phi;
  const int most = ray.picks ? 1 : Pieces::kMost;
  if (pieces.count == most || end - pieces.to[0] > longest_together_) shade(ray, pieces);
}

// A gap at the end is made longer.
void RayCaster::leap(Ray& ray, float end, Pieces& pieces) const {
  if (pieces.ends_with_gap()) --pieces.count;
  if (pieces.count > 0 && end - pieces.to[0] > longest_together_) shade(ray, pieces);
  ray.t = end;
  add_piece(ray, end, pieces.phi[static_cast<std::size_t>(pieces.count)], pieces);
}

void RayCaster::set_phi(Ray& ray, float phi, Pieces& pieces) const {
  if (pieces.phi[static_cast<std::size_t>(pieces.count)] == phi) return;
  leap(ray, ray.t, pieces);
  pieces.phi[static_cast<std::size_t>(pieces.count)] = phi;
}

void RayCaster::shade(Ray& ray, Pieces& pieces) const {
  if (pieces.count == 0) return;
  const float begin = pieces.from[0];
  const float before = ray.result.a;
  shade_pieces_(pieces_, pieces, ray.result);
  if (ray.picks && ray.result.a > before) pick_at(ray, Hit::Kind::source, on(ray, begin));
}

// Where phi is 0 between two places of other signs, by false position (the Illinois variant).
float RayCaster::crossing(const Ray& ray, Piece piece) const {
  float at = piece.a;
  for (int i = 0; i < 3; ++i) {
    at = (piece.a * piece.phi_b - piece.b * piece.phi_a) / (piece.phi_b - piece.phi_a);
    const float phi = scene_.phi.between(on(ray, at));
    if ((phi > 0.0F) == (piece.phi_b > 0.0F)) {
      piece.b = at;
      piece.phi_b = phi;
      piece.phi_a *= 0.5F;
    } else {
      piece.a = at;
      piece.phi_a = phi;
      piece.phi_b *= 0.5F;
    }
  }
  return at;
}

void RayCaster::cast(Ray& ray) const {
  if (ray.whole.x >= ray.whole.y) return;
  // From where anything shows to where nothing does any more.
  ray.t = kNever;
  float end = -kNever;
  const auto include = [&](glm::vec2 part) {
    if (part.x > part.y) return;
    ray.t = std::min(ray.t, part.x);
    end = std::max(end, part.y);
  };
  if (view_.surface || shows_labels_) include(ray.for_surface);
  if (shows_source_) include(ray.for_source);
  if (ray.cut < kNever) include({ray.cut, ray.cut});
  if (ray.t > end) return;
  if (shows_labels_) begin_labels(ray);
  if (needs_phi_) ray.inside = scene_.phi.between(on(ray, ray.t)) > 0.0F;
  // Where the inside meets the volume's border the surface is closed.
  const bool enters_inside = view_.surface && ray.inside && ray.t <= ray.whole.x + kJustBehind;
  for (int layer = 0; layer < kMostLayers && !ray.is_opaque(); ++layer) {
    const bool label_ahead = shows_labels_ && ray.label_border < kNever;
    if (ray.t > end && !label_ahead) break;
    float stop = ray.cut < kNever ? ray.cut : end;
    if (shows_labels_) stop = std::min(stop, ray.label_border);
    const bool enters = layer == 0 && enters_inside;
    const Piece piece = enters ? Piece{} : march(ray, stop);
    bool met = piece.found || enters;
    if (view_.surface) {
      const bool leaves = !met && ray.inside && stop >= ray.whole.y - kJustBehind;
      if (met || leaves) {
        const float at = enters ? ray.whole.x : leaves ? ray.whole.y : crossing(ray, piece);
        if (at >= ray.for_surface.x && at <= ray.for_surface.y) {
          const glm::vec3 p = on(ray, at);
          meet_surface(ray, at, enters || leaves ? face_at(p) * spacing_ : scene_.phi.slope(p));
        }
        if (piece.found) ray.inside = !ray.inside;
      }
    }
    if (shows_labels_ && !met && ray.label_border <= stop) {
      meet_label(ray);
      met = true;
    }
    if (!met && ray.cut < kNever && !ray.is_opaque()) {
      meet_clip_plane(ray);
      ray.cut = kNever;
      met = true;
    }
    if (!met) break;
  }
}

glm::vec3 RayCaster::colour(std::int64_t x, std::int64_t y) const {
  const glm::vec2 span = spans_.at(x, y);
  if (span.x > span.y && !(plane_ && view_.clip->picture)) return view_.background;
  const glm::vec2 size(size_.width, size_.height);
  const glm::vec2 pixel(static_cast<float>(x) + 0.5F, static_cast<float>(size_.height - y) - 0.5F);
  Ray ray = begin(2.0F * pixel / size - 1.0F, span);
  ray.jitter = jitter(pixel, view_.quality.round);
  cast(ray);
  return glm::vec3(ray.result) + (1.0F - ray.result.a) * view_.background;
}

std::optional<Hit> RayCaster::pick(glm::dvec2 pixel) const {
  const glm::dvec2 size(size_.width, size_.height);
  const glm::dvec2 inside = glm::clamp(pixel, glm::dvec2(0.0), size - 1.0);
  const glm::dvec2 place = 2.0 * (pixel + 0.5) / size - 1.0;
  Ray ray = begin(glm::vec2(place.x, -place.y),
                  spans_.at(static_cast<std::int64_t>(inside.x), static_cast<std::int64_t>(inside.y)));
  ray.picks = true;
  cast(ray);
  return ray.picked;
}

void RayCaster::pick_at(Ray& ray, Hit::Kind kind, glm::vec3 p) const {
  if (!ray.picks || ray.picked || ray.result.a <= 0.5F) return;
  ray.picked = Hit{kind, glm::dvec3(p), scene_.geometry().to_patient(glm::dvec3(p))};
}

}  // namespace tidemark::renderer
