// The source as 2D slices along an axis, sent to the GPU when it is their turn: no volume is too large for
// it.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/volume.h"
#include "gpu/draw.h"
#include "renderer/gl/draw_throttle.h"
#include "renderer/gl/slice_pair.h"

namespace tidemark::renderer {

// Two slices are kept at a time, of the source's values and its gradient. They are made from three stored
// slices, by differences over a voxel to each side.
class SourceStack {
 public:
  SourceStack() = default;
  static Result<SourceStack> create(gpu::Device& device, const Volume& source, const SliceAxis& axis);

  // Begins a picture.
  void begin() { pair_.forget(); }
  // Makes sure that a slice is there, at least its `part`. `source` is that of create(). Uses three units.
  Status prepare(const Volume& source, std::int64_t slice, const gpu::TexelRect& part, int unit,
                 DrawThrottle& throttle);

  [[nodiscard]] const gpu::Texture2D& texture(std::int64_t slice) const { return pair_.texture(slice); }

 private:
  struct Stored {
    gpu::Texture2D texture;
    std::int64_t slice = -1;
  };
  Status send(const Volume& source, std::int64_t slice, DrawThrottle& throttle);
  template <class Scalar>
  std::span<const std::byte> gather(const std::vector<Scalar>& voxels, std::int64_t slice);

  SliceAxis axis_;
  SlicePair pair_;
  std::array<Stored, 3> stored_;
  glm::vec2 scale_{1.0F, 0.0F};  // of stored values
  gpu::Program program_;
  gpu::VertexArray vertices_;
  std::vector<std::byte> gathered_;  // slices from first_gathered_ on, where they do not lie in one piece
  std::int64_t first_gathered_ = -1;
};

// The texture format of a volume's stored values, and the way back to its values:
// value = scale.x * texel + scale.y.
struct StoredAs {
  gpu::TexelFormat format = gpu::TexelFormat::r32f;
  glm::vec2 scale{1.0F, 0.0F};
};
StoredAs stored_as(const Volume& source);

}  // namespace tidemark::renderer
