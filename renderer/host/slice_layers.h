// The layers of a slice's picture, tile by tile: the source or what is shown in its place,
// further images, labels, the surface's motion, walls and anchors, contours of phi, and the surface's
// outline.
#pragma once

#include "renderer/host/host_scene.h"
#include "renderer/host/slice_tile.h"

namespace tidemark::renderer {

class SliceLayers {
 public:
  // `map`: the one that the view shows, evaluated around the plane; null: none. All outlive the layers.
  SliceLayers(const HostScene& scene, const SliceView& view, const SlicePlane& plane, PictureSize size,
              const MapSamples* map);

  // Fills the tile, whose place is known, and its colours. Where the source in its window is all that shows
  // it returns false, and only tile.source is filled: with shares of white.
  [[nodiscard]] bool draw(SliceTile& tile) const;

 private:
  enum class Base { source, data, term, doubt, pages };

  [[nodiscard]] float grey(float value) const {
    return glm::clamp((value - centre_) / width_ + 0.5F, 0.0F, 1.0F);
  }
  [[nodiscard]] bool is_outside(glm::vec3 position) const;
  [[nodiscard]] bool shows_labels(const SliceTile& tile) const;
  [[nodiscard]] bool shows_constraints(const SliceTile& tile) const;
  void draw_base(SliceTile& tile) const;
  void draw_beside(SliceTile& tile) const;

  void draw_data_speed(SliceTile& tile) const;
  void draw_term(SliceTile& tile) const;
  void colour_speed(SliceTile& tile, const SliceTile::Values& speed) const;
  void draw_doubt(SliceTile& tile) const;
  void draw_pages(SliceTile& tile) const;

  [[nodiscard]] glm::vec3 with_images(glm::vec3 below, int x, int y) const;
  void add_labels(SliceTile& tile) const;
  void add_change(SliceTile& tile) const;
  void add_constraints(SliceTile& tile) const;
  void add_lines(SliceTile& tile) const;

  const HostScene& scene_;
  const SliceView& view_;
  const MapSamples* map_;
  PictureSize size_;
  glm::ivec3 volume_;
  glm::vec3 right_;  // a pixel, in voxels
  glm::vec3 up_;
  float centre_ = 0.0F;  // of the window
  float width_ = 1.0F;
  Base base_ = Base::source;
  bool has_images_ = false;
  bool has_labels_ = false;
  bool has_change_ = false;
};

}  // namespace tidemark::renderer
