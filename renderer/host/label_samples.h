// Labels between voxels: the processor's side of resources/shaders/render/labels.glsl.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "renderer/label_volume.h"

namespace tidemark::renderer {

class LabelSamples {
 public:
  explicit LabelSamples(const PageLayout& layout);

  void set_voxels(const PagedBytes& voxels) { volume_.set_voxels(voxels); }
  // Of the labels from 0 on.
  void set_colours(std::span<const LabelColour> colours);
  // Works out where borders are between voxels, which pictures in 3D need.
  void prepare_borders() { volume_.prepare_borders(); }

  [[nodiscard]] const LabelPages& pages() const { return volume_.pages(); }
  // Red, green and blue, 0 to 1, and opacity.
  [[nodiscard]] glm::vec3 colour(int label) const;
  [[nodiscard]] float opacity(int label) const;

  // 0 where the label is hidden, too. Clamped to the volume.
  [[nodiscard]] int at(glm::ivec3 voxel) const { return seen(volume_.voxels().at(clamped(voxel))); }
  // prepare_borders() comes before these. Voxel coordinates, integers at voxel centres.
  [[nodiscard]] int between(glm::vec3 position) const;
  // d (share of the label) / d voxel, from differences over a voxel to each side.
  [[nodiscard]] glm::vec3 slope(int label, glm::vec3 position) const;

 private:
  struct Share {
    float share;  // above a half where the place has the label
    int other;    // the nearest voxel's that has another one
  };
  // The eight voxels around a position, i fastest; those beyond the volume are its outermost ones.
  struct Cell {
    Cell(const LabelSamples& samples, glm::vec3 position);
    [[nodiscard]] bool is_even() const;  // of one label

    std::array<Index3, 2> ends;
    glm::vec3 far_share;  // of the upper end along each axis
    std::array<std::uint8_t, 8> labels;
  };
  [[nodiscard]] int seen(int label) const { return pages().is_seen(label) ? label : 0; }
  [[nodiscard]] Share share_of(int label, const Cell& cell) const;
  [[nodiscard]] Index3 clamped(glm::ivec3 voxel) const;

  glm::ivec3 size_{0};
  LabelVolume volume_;
  std::vector<LabelColour> colours_;
};

}  // namespace tidemark::renderer
