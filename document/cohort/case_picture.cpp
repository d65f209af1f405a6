#include "document/cohort/case_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "core/region.h"

namespace tidemark::cohort {
namespace {

constexpr std::array<std::uint8_t, 3> kSurfaceYellow{255, 214, 10};

WindowLevel window_of(const Volume& source) {
  if (source.window) return *source.window;
  const auto [low, high] = source.common_range();
  const double width = static_cast<double>(high) - static_cast<double>(low);
  return {0.5 * (static_cast<double>(low) + static_cast<double>(high)), width > 0.0 ? width : 1.0};
}

// The middle of what is inside; of the volume where nothing is.
Index3 middle_of(const Mask& mask) {
  const VoxelRange inside = Region(mask).bounds();
  if (inside.empty()) return mask.geometry.size / std::int64_t{2};
  return (inside.low + inside.high - Index3(1)) / std::int64_t{2};
}

// Screens show left, back and feet to the right and below.
bool runs_against_the_screen(glm::dvec3 direction) {
  const glm::dvec3 size = glm::abs(direction);
  if (size.z > size.x && size.z > size.y) return direction.z > 0.0;
  return (size.x > size.y ? direction.x : direction.y) < 0.0;
}

// One slice in a square of the picture.
class Slice {
 public:
  // Along `across` from the left, and along `down`, through `middle`.
  Slice(const Geometry& grid, int across, int down, Index3 middle, int side)
      : grid_(grid), axes_{across, down}, middle_(middle), side_(side) {
    double extent_mm = 0.0;
    for (const int axis : axes_) {
      extent_mm = std::max(extent_mm, static_cast<double>(grid.size[axis]) * grid.spacing_mm[axis]);
    }
    for (std::size_t i = 0; i < 2; ++i) {
      voxels_a_pixel_[i] = extent_mm / side / grid.spacing_mm[axes_[i]];
      flipped_[i] = runs_against_the_screen(grid.direction[axes_[i]]);
    }
  }

  // False outside of the grid.
  bool voxel_at(int x, int y, Index3& voxel) const {
    voxel = middle_;
    const std::array<int, 2> pixel{x, y};
    for (std::size_t i = 0; i < 2; ++i) {
      const auto size = grid_.size[axes_[i]];
      const double from_middle = (pixel[i] + 0.5 - 0.5 * side_) * voxels_a_pixel_[i];
      const auto index = static_cast<std::int64_t>(
          std::floor(0.5 * static_cast<double>(size) + (flipped_[i] ? -from_middle : from_middle)));
      if (index < 0 || index >= size) return false;
      voxel[axes_[i]] = index;
    }
    return true;
  }

  [[nodiscard]] bool is_inside(const Mask& mask, int x, int y) const {
    Index3 voxel{0};
    return voxel_at(x, y, voxel) && mask.voxels[static_cast<std::size_t>(grid_.offset(voxel))] != 0;
  }

 private:
  const Geometry& grid_;
  std::array<int, 2> axes_;
  Index3 middle_;
  int side_;
  std::array<double, 2> voxels_a_pixel_{};
  std::array<bool, 2> flipped_{};
};

void draw(CasePicture& picture, int left, const Slice& slice, const Volume& source, const WindowLevel& window,
          const Mask& mask) {
  const int side = picture.height;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      Index3 voxel{0};
      if (!slice.voxel_at(x, y, voxel)) continue;
      std::uint8_t* pixel =
          picture.pixels.data() + 4 * (static_cast<std::ptrdiff_t>(y) * picture.width + left + x);
      const bool inside = slice.is_inside(mask, x, y);
      const bool border = inside && (!slice.is_inside(mask, x - 1, y) || !slice.is_inside(mask, x + 1, y) ||
                                     !slice.is_inside(mask, x, y - 1) || !slice.is_inside(mask, x, y + 1));
      const double share = 0.5 + (source.value(voxel) - window.centre) / std::max(window.width, 1e-9);
      const auto grey = static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(share, 0.0, 1.0)));
      for (std::size_t c = 0; c < 3; ++c) pixel[c] = border ? kSurfaceYellow[c] : grey;
    }
  }
}

}  // namespace

CasePicture case_picture(const Volume& source, const Mask& mask, int side) {
  CasePicture picture{3 * side, side, {}};
  picture.pixels.assign(static_cast<std::size_t>(4 * picture.width * picture.height), 0);
  for (std::size_t i = 3; i < picture.pixels.size(); i += 4) picture.pixels[i] = 255;
  const Index3 middle = middle_of(mask);
  const WindowLevel window = window_of(source);
  constexpr int kAxes[3][2] = {{0, 1}, {0, 2}, {1, 2}};
  for (int i = 0; i < 3; ++i) {
    draw(picture, i * side, Slice(source.geometry, kAxes[i][0], kAxes[i][1], middle, side), source, window,
         mask);
  }
  return picture;
}

}  // namespace tidemark::cohort
