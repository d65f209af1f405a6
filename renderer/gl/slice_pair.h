// Two slices next to each other, kept while what lies between them is drawn.
#pragma once

#include <array>

#include "gpu/framebuffer.h"
#include "renderer/gl/slice_axis.h"

namespace tidemark::renderer {

// Four values a voxel, filtered by the hardware. Slice i takes the place of slice i - 2 or i + 2.
class SlicePair {
 public:
  SlicePair() = default;
  static Result<SlicePair> create(gpu::Device& device, const SliceAxis& axis, std::string_view label);

  [[nodiscard]] bool holds(std::int64_t slice) const { return place(slice).slice == slice; }
  [[nodiscard]] const gpu::Texture2D& texture(std::int64_t slice) const { return place(slice).texture; }
  // The next draws make this slice.
  void begin(std::int64_t slice);
  void forget();

 private:
  struct Place {
    gpu::Texture2D texture;
    gpu::Framebuffer framebuffer;
    std::int64_t slice = -1;
  };
  [[nodiscard]] const Place& place(std::int64_t slice) const {
    return places_[static_cast<std::size_t>(slice & 1)];
  }

  std::array<Place, 2> places_;
};

}  // namespace tidemark::renderer
