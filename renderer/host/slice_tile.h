// A tile of a slice's picture: where its pixels are in the volume, and what is there.
#pragma once

#include <array>
#include <cmath>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "renderer/host/phi_pages.h"
#include "renderer/host/source_samples.h"
#include "renderer/picture.h"

namespace tidemark::renderer {

// From pixels, whole numbers at their middles, x to the right and y up from the picture's bottom left, to
// voxel coordinates.
struct SlicePlane {
  glm::dvec3 first;  // the bottom left pixel's
  glm::dvec3 right;  // a pixel
  glm::dvec3 up;

  // From the view, x and y in -1..1.
  SlicePlane(const glm::dmat4& voxel_from_view, PictureSize size);
  [[nodiscard]] glm::dvec3 at(int x, int y) const {
    return first + right * static_cast<double>(x) + up * static_cast<double>(y);
  }
};

inline glm::ivec3 nearest_voxel(glm::vec3 position, glm::ivec3 size) {
  // Not negative, so that the cast rounds down.
  return glm::ivec3(glm::clamp(position, glm::vec3(0.0F), glm::vec3(size - 1)) + 0.5F);
}

// Whether any page from `first` to `last` passes a test.
template <class Test>
bool any_page(glm::ivec3 first, glm::ivec3 last, const Test& test) {
  for (int z = first.z; z <= last.z; ++z) {
    for (int y = first.y; y <= last.y; ++y) {
      for (int x = first.x; x <= last.x; ++x) {
        if (test(glm::ivec3(x, y, z))) return true;
      }
    }
  }
  return false;
}

// Sides are even: the quads of 2 x 2 pixels that OpenGL takes differences in lie in one tile. Where the
// picture has not as many pixels the tile reaches beyond it.
struct SliceTile {
  static constexpr int kWidth = 32;
  static constexpr int kHeight = 16;
  static constexpr int kPixels = kWidth * kHeight;
  using Values = std::array<float, kPixels>;

  int left = 0;    // pixels from the picture's left
  int bottom = 0;  // pixels from its bottom
  Values x;        // of the pixels, in voxel coordinates
  Values y;
  Values z;
  Values source;  // in its units
  Values phi;
  std::array<glm::vec3, kPixels> colour;

  // The voxels that are read around the pixels: from low to high, inside of the volume.
  glm::ivec3 low{0};
  glm::ivec3 high{0};
  bool crosses_border = false;  // whether a pixel may lie outside of the volume

  void place(const SlicePlane& plane, int left_pixel, int bottom_pixel, glm::ivec3 volume);
  // Returns whether the surface may be near; phi is the same throughout the tile where it is not.
  bool sample_phi(const PhiPages& pages);

  [[nodiscard]] glm::vec3 position(std::size_t pixel) const { return {x[pixel], y[pixel], z[pixel]}; }

  // Differences of OpenGL: within the quad of a pixel.
  static float along_x(const Values& values, int pixel) {
    return values[at(pixel | 1)] - values[at(pixel & ~1)];
  }
  static float along_y(const Values& values, int pixel) {
    return values[at(pixel | kWidth)] - values[at(pixel & ~kWidth)];
  }
  static float slope(const Values& values, int pixel) {
    const float x = along_x(values, pixel);
    const float y = along_y(values, pixel);
    return std::sqrt(x * x + y * y);
  }

 private:
  static std::size_t at(int pixel) { return static_cast<std::size_t>(pixel); }
};

}  // namespace tidemark::renderer
