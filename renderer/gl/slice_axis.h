// The axis of slices in a volume: the C++ side of resources/shaders/render/slice_axes.glsl.
#pragma once

#include <fmt/format.h>

#include "gpu/program.h"
#include "gpu/texture.h"

namespace tidemark::renderer {

// Slices across an axis of the volume; `u` and `v` are a slice's own axes.
struct SliceAxis {
  int along = 2;
  Index3 size{0};  // the volume's

  bool operator==(const SliceAxis&) const = default;
  [[nodiscard]] int u() const { return along == 0 ? 1 : 0; }
  [[nodiscard]] int v() const { return along == 2 ? 1 : 2; }
  [[nodiscard]] std::int64_t count() const { return size[along]; }
  [[nodiscard]] std::int64_t width() const { return size[u()]; }
  [[nodiscard]] std::int64_t height() const { return size[v()]; }
  [[nodiscard]] gpu::TexelRect rect() const { return {0, 0, width(), height()}; }
  [[nodiscard]] std::pair<std::string, std::string> define() const {
    return {"SLICE_AXIS", fmt::to_string(along)};
  }
};

}  // namespace tidemark::renderer
