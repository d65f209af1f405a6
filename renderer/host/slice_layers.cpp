#include "renderer/host/slice_layers.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "renderer/host/colours.h"
#include "renderer/host/slice_samples.h"
#include "renderer/host/speed_terms.h"
#include "renderer/host/trilinear.h"

namespace tidemark::renderer {
namespace {

// In the desktop's own colours and patterns (resources/shaders/render/constraints.glsl).
constexpr glm::vec3 kWallColour(1.0F, 0.35F, 0.35F);
constexpr glm::vec3 kAnchorColour(0.47F, 0.90F, 0.51F);

// Calls body(i, x, y) for the pixels of a tile, x and y from the picture's bottom left.
template <class Body>
void for_each_pixel(const SliceTile& tile, const Body& body) {
  std::size_t i = 0;
  for (int y = 0; y < SliceTile::kHeight; ++y) {
    for (int x = 0; x < SliceTile::kWidth; ++x) body(i++, tile.left + x, tile.bottom + y);
  }
}

// Every eighth diagonal line of pixels is dark, so that shrinking needs no colour.
bool is_hatched(int x, int y) {
  return ((x + y + 1) & 7) < 2;
}

// A term at voxels that several pixels of a tile share.
class TermsOfTile {
 public:
  TermsOfTile(const SpeedTerms& terms, SpeedTerm term) : terms_(terms), term_(term) { keys_.fill(-1); }

  float between(glm::vec3 position) {
    const Trilinear around(position, terms_.source.size());
    float sum = 0.0F;
    for (int i = 0; i < 8; ++i) {
      const float share = around.share(i);
      if (share > 0.0F) sum += share * at(around.corner(i));
    }
    return sum;
  }

 private:
  static constexpr std::size_t kEntries = 1024;

  float at(glm::ivec3 voxel) {
    const glm::ivec3 size = terms_.source.size();
    const std::int64_t key = voxel.x + size.x * (voxel.y + std::int64_t{size.y} * voxel.z);
    const std::size_t entry = static_cast<std::size_t>(voxel.x + 37 * voxel.y + 331 * voxel.z) % kEntries;
    if (keys_[entry] != key) {
      keys_[entry] = key;
      speeds_[entry] = terms_.at(term_, voxel).speed;
    }
    return speeds_[entry];
  }

  const SpeedTerms& terms_;
  SpeedTerm term_;
  std::array<std::int64_t, kEntries> keys_;
  std::array<float, kEntries> speeds_;
};

SpeedTerms terms_of(const HostScene& scene, const MapSamples* map) {
  return {scene.phi, scene.source, map, scene.tent(), scene.constants};
}

}  // namespace

SliceLayers::SliceLayers(const HostScene& scene, const SliceView& view, const SlicePlane& plane,
                         PictureSize size, const MapSamples* map)
    : scene_(scene),
      view_(view),
      map_(map),
      size_(size),
      volume_(scene.source.size()),
      right_(plane.right),
      up_(plane.up),
      centre_(static_cast<float>(view.window.centre)),
      width_(static_cast<float>(view.window.width)) {
  switch (view.content) {
    case SliceContent::source:
      has_images_ = view.images != nullptr;
      has_change_ = map != nullptr;
      break;
    case SliceContent::speed:
      base_ = view.term == SpeedTerm::data    ? Base::data
              : view.term == SpeedTerm::doubt ? Base::doubt
                                              : Base::term;
      break;
    case SliceContent::pages:
      base_ = Base::pages;
      break;
  }
  has_labels_ = scene.labels.pages().show_at(view.label_opacity);
}

bool SliceLayers::is_outside(glm::vec3 p) const {
  const glm::vec3 end = glm::vec3(volume_) - 0.5F;
  return p.x < -0.5F || p.y < -0.5F || p.z < -0.5F || p.x > end.x || p.y > end.y || p.z > end.z;
}

bool SliceLayers::shows_labels(const SliceTile& tile) const {
  const PhiPages& pages = scene_.phi;
  return has_labels_ && any_page(pages.page_of(tile.low), pages.page_of(tile.high), [&](glm::ivec3 page) {
           return scene_.labels.pages().pages()[static_cast<std::size_t>(pages.page_number(page))] != 0;
         });
}

bool SliceLayers::shows_constraints(const SliceTile& tile) const {
  if (!scene_.constraints) return false;
  const PageLayout& layout = scene_.constraints->layout();
  const glm::ivec3 shape(layout.page_shape());
  return any_page(tile.low / shape, tile.high / shape, [&](glm::ivec3 page) {
    return scene_.constraints->page(layout.page_number(Index3(page))) != nullptr;
  });
}

bool SliceLayers::draw(SliceTile& tile) const {
  // The map of D shows the source between voxels, whatever is asked for.
  sample_source(scene_.source, view_.nearest && base_ != Base::data, tile);
  const bool surface_near = tile.sample_phi(scene_.phi);
  const bool lines = (view_.surface || view_.contours) && surface_near;
  const bool labels = shows_labels(tile);
  const bool constraints = shows_constraints(tile);
  if (base_ == Base::source && !has_images_ && !has_change_ && !lines && !labels && !constraints &&
      !tile.crosses_border) {
    for (float& value : tile.source) value = grey(value);
    return false;
  }
  draw_base(tile);
  if (has_images_) {
    for_each_pixel(tile,
                   [&](std::size_t i, int x, int y) { tile.colour[i] = with_images(tile.colour[i], x, y); });
  }
  if (labels) add_labels(tile);
  if (has_change_) add_change(tile);
  if (constraints) add_constraints(tile);
  if (lines) add_lines(tile);
  if (tile.crosses_border) draw_beside(tile);
  return true;
}

void SliceLayers::draw_base(SliceTile& tile) const {
  switch (base_) {
    case Base::source:
      for (std::size_t i = 0; i < SliceTile::kPixels; ++i) tile.colour[i] = glm::vec3(grey(tile.source[i]));
      return;
    case Base::data:
      return draw_data_speed(tile);
    case Base::term:
      return draw_term(tile);
    case Base::doubt:
      return draw_doubt(tile);
    case Base::pages:
      return draw_pages(tile);
  }
}

void SliceLayers::draw_beside(SliceTile& tile) const {
  for_each_pixel(tile, [&](std::size_t i, int x, int y) {
    if (!is_outside(tile.position(i))) return;
    tile.colour[i] = has_images_ ? with_images(view_.background, x, y) : view_.background;
  });
}

void SliceLayers::draw_data_speed(SliceTile& tile) const {
  const SpeedTerms terms = terms_of(scene_, map_);
  SliceTile::Values speed;
  for (std::size_t i = 0; i < SliceTile::kPixels; ++i) {
    speed[i] = map_ != nullptr ? map_->between(tile.position(i)) : terms.data_of(tile.source[i]);
  }
  colour_speed(tile, speed);
}

void SliceLayers::draw_term(SliceTile& tile) const {
  // The terms are defined only near the surface; the line where they change their sign needs a pixel's
  // neighbours.
  SliceTile::Values near;
  const float limit = 0.98F * scene_.phi.band();
  for (std::size_t i = 0; i < SliceTile::kPixels; ++i) near[i] = std::abs(tile.phi[i]) < limit ? 1.0F : 0.0F;
  const SpeedTerms terms = terms_of(scene_, map_);
  TermsOfTile at_voxels(terms, view_.term);
  SliceTile::Values speed;
  bool any = false;
  for (int i = 0; i < SliceTile::kPixels; ++i) {
    const auto pixel = static_cast<std::size_t>(i);
    const bool wanted =
        near[pixel] > 0.0F || SliceTile::along_x(near, i) != 0.0F || SliceTile::along_y(near, i) != 0.0F;
    speed[pixel] = wanted ? at_voxels.between(tile.position(pixel)) : 0.0F;
    any = any || wanted;
  }
  if (any) colour_speed(tile, speed);
  for (std::size_t i = 0; i < SliceTile::kPixels; ++i) {
    if (near[i] == 0.0F) tile.colour[i] = glm::vec3(0.5F * grey(tile.source[i]));
  }
}

void SliceLayers::colour_speed(SliceTile& tile, const SliceTile::Values& speed) const {
  for_each_pixel(tile, [&](std::size_t i, int x, int y) {
    const bool changes_sign = std::abs(speed[i]) < 0.7F * SliceTile::slope(speed, static_cast<int>(i));
    glm::vec3 colour = diverging(speed[i]);
    if (speed[i] < 0.0F && is_hatched(x, y)) colour *= 0.75F;
    tile.colour[i] = changes_sign ? glm::vec3(0.1F) : colour;
  });
}

// Sure parts show the dimmed source. So does all of a function without a doubt.
void SliceLayers::draw_doubt(SliceTile& tile) const {
  for (std::size_t i = 0; i < SliceTile::kPixels; ++i) {
    const glm::vec3 dimmed(0.5F * grey(tile.source[i]));
    const float doubt = map_ != nullptr ? glm::clamp(map_->between(tile.position(i)), 0.0F, 1.0F) : 0.0F;
    tile.colour[i] = glm::mix(dimmed, doubt_colour(doubt), 0.8F * glm::smoothstep(0.0F, 0.5F, doubt));
  }
}

void SliceLayers::draw_pages(SliceTile& tile) const {
  const PhiPages& pages = scene_.phi;
  const glm::vec3 shape(pages.page_shape());
  // Along the slice's own axis there is no edge to be seen.
  const glm::vec3 width = (glm::abs(right_) + glm::abs(up_)) / shape;
  for (std::size_t i = 0; i < SliceTile::kPixels; ++i) {
    const glm::vec3 p = tile.position(i);
    const int page = pages.page_number(pages.page_of(nearest_voxel(p, volume_)));
    const PageState state = pages.state(page);
    const bool resident = state >= PageState::resident;
    glm::vec3 colour = glm::mix(glm::vec3(grey(tile.source[i])), page_colour(state), resident ? 0.45F : 0.2F);
    const glm::vec3 in_page = (p + 0.5F) / shape;
    bool on_edge = false;  // in_page is not negative where something is seen
    for (int axis = 0; axis < 3; ++axis) {
      const float from_edge =
          std::abs(in_page[axis] - static_cast<float>(static_cast<int>(in_page[axis] + 0.5F)));
      on_edge = on_edge || (width[axis] > 1e-6F && from_edge < 0.6F * width[axis]);
    }
    if (resident && on_edge) colour = glm::mix(colour, glm::vec3(1.0F), 0.5F);
    tile.colour[i] = colour;
  }
}

// The images' first row is the picture's top.
glm::vec3 SliceLayers::with_images(glm::vec3 below, int x, int y) const {
  const ImagesOver& images = *view_.images;
  const float from_left = (static_cast<float>(x) + 0.5F) / static_cast<float>(size_.width);
  const float from_top = 1.0F - (static_cast<float>(y) + 0.5F) / static_cast<float>(size_.height);
  if (from_left < static_cast<float>(view_.images_from)) return below;
  const auto nearest_two = [](float from_edge, std::int64_t count, std::int64_t(&texels)[2]) {
    const float place = from_edge * static_cast<float>(count) - 0.5F;
    const float low = std::floor(place);
    texels[0] = std::clamp(static_cast<std::int64_t>(low), std::int64_t{0}, count - 1);
    texels[1] = std::clamp(static_cast<std::int64_t>(low) + 1, std::int64_t{0}, count - 1);
    return place - low;
  };
  std::int64_t u[2];
  std::int64_t v[2];
  const float across = nearest_two(from_left, images.width, u);
  const float down = nearest_two(from_top, images.height, v);
  const auto texel = [&](int i, int j) {
    const std::uint8_t* rgba = images.rgba.data() + 4 * (u[i] + images.width * v[j]);
    return glm::vec4(rgba[0], rgba[1], rgba[2], rgba[3]);
  };
  const glm::vec4 over =
      glm::mix(glm::mix(texel(0, 0), texel(1, 0), across), glm::mix(texel(0, 1), texel(1, 1), across), down) /
      255.0F;
  return glm::vec3(over) + (1.0F - over.a) * below;
}

void SliceLayers::add_labels(SliceTile& tile) const {
  const LabelSamples& labels = scene_.labels;
  const auto opacity = static_cast<float>(view_.label_opacity);
  for (std::size_t i = 0; i < SliceTile::kPixels; ++i) {
    const int label = labels.at(nearest_voxel(tile.position(i), volume_));
    if (label == 0) continue;
    tile.colour[i] = glm::mix(tile.colour[i], labels.colour(label), opacity * labels.opacity(label));
  }
}

// What was won is tinted in the colour of growth, what was lost in that of shrinking, and hatched; a dark
// line is where the surface began. The map is positive outside of the start.
void SliceLayers::add_change(SliceTile& tile) const {
  SliceTile::Values shift;
  for (std::size_t i = 0; i < SliceTile::kPixels; ++i) shift[i] = map_->between(tile.position(i));
  for_each_pixel(tile, [&](std::size_t i, int x, int y) {
    const bool changed = (shift[i] > 0.0F) == (tile.phi[i] > 0.0F);
    if (changed) {
      glm::vec3 tint = diverging(shift[i]);
      if (shift[i] < 0.0F && is_hatched(x, y)) tint *= 0.75F;
      tile.colour[i] = glm::mix(tile.colour[i], tint, 0.65F);
    }
    if (std::abs(shift[i]) >= 0.99F) return;
    const float slope = std::max(SliceTile::slope(shift, static_cast<int>(i)), 1e-6F);
    const float line = 1.0F - glm::smoothstep(0.3F, 1.0F, std::abs(shift[i]) / slope);
    tile.colour[i] = glm::mix(tile.colour[i], glm::vec3(0.0F), 0.8F * line);
  });
}

// Walls are cross-hatched and anchors dotted, so that they are told apart without colours, too.
void SliceLayers::add_constraints(SliceTile& tile) const {
  const auto of_six = [](int n) { return ((n % 6) + 6) % 6; };
  for_each_pixel(tile, [&](std::size_t i, int x, int y) {
    const solver::Constraint what = scene_.constraints->at(Index3(nearest_voxel(tile.position(i), volume_)));
    if (what != solver::Constraint::wall && what != solver::Constraint::anchor) return;
    const bool wall = what == solver::Constraint::wall;
    const bool strong = wall ? std::min(of_six(x - y), of_six(x + y + 1)) < 2 : (x & 3) < 2 && (y & 3) < 2;
    tile.colour[i] = glm::mix(tile.colour[i], wall ? kWallColour : kAnchorColour, strong ? 0.85F : 0.3F);
  });
}

void SliceLayers::add_lines(SliceTile& tile) const {
  const glm::vec3 spacing(scene_.geometry().spacing_mm);
  const float pixel = glm::length(right_ * spacing) / std::min({spacing.x, spacing.y, spacing.z});
  const float half_line = 0.5F * static_cast<float>(view_.line_pixels);
  for (std::size_t i = 0; i < SliceTile::kPixels; ++i) {
    const float phi = std::abs(tile.phi[i]);
    if (phi >= scene_.phi.band()) continue;
    // Where the slice grazes the surface phi hardly changes in it; a line must not become a patch.
    const float slope = SliceTile::slope(tile.phi, static_cast<int>(i));
    const float per_pixel = std::max(slope, 0.4F * pixel);
    // Nor where phi is the same over a whole area, half-way between two slices of a mask.
    const float steep = glm::smoothstep(0.1F, 0.4F, slope / pixel);
    if (view_.contours) {
      const float to_contour = std::abs(phi - (phi < 1.5F ? 1.0F : 2.0F));
      const float line = steep * (1.0F - glm::smoothstep(0.0F, 1.0F, to_contour / per_pixel));
      tile.colour[i] = glm::mix(tile.colour[i], tile.phi[i] < 0.0F ? kContourOutside : kContourInside, line);
    }
    if (view_.surface) {
      const float line =
          steep * (1.0F - glm::smoothstep(half_line - 0.5F, half_line + 0.5F, phi / per_pixel));
      tile.colour[i] = glm::mix(tile.colour[i], kOutlineYellow, line);
    }
  }
}

}  // namespace tidemark::renderer
