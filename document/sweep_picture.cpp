#include "document/sweep_picture.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <optional>

namespace tidemark::document {
namespace {

constexpr SweepColour kSurfaceYellow{255, 214, 10};
constexpr double kTint = 0.3;          // of the inside
constexpr double kHeat = 0.65;         // of the agreement
constexpr double kMargin = 1.5;        // the square by what it is around
constexpr double kLeastVoxels = 16.0;  // of the square

// Where a picture's pixels lie in the grid.
class Place {
 public:
  Place(const Geometry& grid, const SweepCut& cut, int side) : grid_(grid), cut_(cut), side_(side) {
    for (int axis = 0; axis < 2; ++axis) {
      voxels_a_pixel_[axis] = cut.side_mm / grid.spacing_mm[axis] / side;
      if (runs_against_the_screen(grid.direction[axis])) voxels_a_pixel_[axis] *= -1.0;
    }
  }

  // Nothing outside of the grid.
  [[nodiscard]] std::optional<Index3> voxel(int x, int y) const {
    const glm::dvec2 from_middle = glm::dvec2(x, y) + 0.5 - 0.5 * side_;
    const glm::dvec2 at = glm::floor(cut_.middle + from_middle * voxels_a_pixel_ + 0.5);
    const Index3 voxel(static_cast<std::int64_t>(at.x), static_cast<std::int64_t>(at.y), cut_.k);
    return grid_.contains(voxel) ? std::optional(voxel) : std::nullopt;
  }

 private:
  // Screens show left, back and feet to the right and below.
  static bool runs_against_the_screen(glm::dvec3 direction) {
    const glm::dvec3 size = glm::abs(direction);
    if (size.z > size.x && size.z > size.y) return direction.z > 0.0;
    return (size.x > size.y ? direction.x : direction.y) < 0.0;
  }

  const Geometry& grid_;
  const SweepCut& cut_;
  int side_;
  glm::dvec2 voxels_a_pixel_{1.0};
};

std::uint8_t mixed(double from, double to, double share) {
  return static_cast<std::uint8_t>(std::lround(from + (to - from) * share));
}

// `colour` returns what lies over the voxel that a pixel shows, and how much of it.
template <class Colour>
SweepPicture painted(const Volume& source, const WindowLevel& window, const SweepCut& cut, int side,
                     const Colour& colour) {
  SweepPicture picture{side, {}};
  picture.pixels.assign(static_cast<std::size_t>(4 * side * side), 0);
  const Place place(source.geometry, cut, side);
  std::uint8_t* pixel = picture.pixels.data();
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x, pixel += 4) {
      pixel[3] = 255;
      const auto voxel = place.voxel(x, y);
      if (!voxel) continue;
      const double share = 0.5 + (source.value(*voxel) - window.centre) / std::max(window.width, 1e-9);
      const double grey = 255.0 * std::clamp(share, 0.0, 1.0);
      const auto [over, opacity] = colour(place, *voxel, x, y);
      for (std::size_t c = 0; c < 3; ++c) pixel[c] = mixed(grey, over[c], opacity);
    }
  }
  return picture;
}

// Of each slice of the box how much is inside in so many runs.
struct Extent {
  std::int64_t voxels = 0;
  Index3 low{0};
  Index3 high{0};
};
Extent extent_in(const Agreement& agreement, std::int64_t k, int least) {
  Extent extent;
  const Index3 first = agreement.first();
  extent.low = first + agreement.size();
  extent.high = first;
  for (std::int64_t j = first.y; j < first.y + agreement.size().y; ++j) {
    for (std::int64_t i = first.x; i < first.x + agreement.size().x; ++i) {
      if (agreement.count({i, j, k}) < least) continue;
      ++extent.voxels;
      extent.low = glm::min(extent.low, Index3(i, j, k));
      extent.high = glm::max(extent.high, Index3(i, j, k));
    }
  }
  return extent;
}

Extent largest_extent(const Agreement& agreement, int least) {
  Extent largest;
  for (std::int64_t k = 0; k < agreement.size().z; ++k) {
    const Extent extent = extent_in(agreement, agreement.first().z + k, least);
    if (extent.voxels > largest.voxels) largest = extent;
  }
  return largest;
}

}  // namespace

SweepCut sweep_cut(const Agreement& agreement, const Geometry& grid) {
  Extent extent = largest_extent(agreement, std::max(1, agreement.surfaces() / 4));
  if (extent.voxels == 0) extent = largest_extent(agreement, 1);
  const glm::dvec2 spacing(grid.spacing_mm);
  if (extent.voxels == 0) {
    const glm::dvec2 size(grid.size);
    const glm::dvec2 side = size * spacing;
    return {grid.size.z / 2, 0.5 * (size - 1.0), std::max(side.x, side.y)};
  }
  const glm::dvec2 side = (glm::dvec2(extent.high - extent.low) + 1.0) * spacing;
  return {extent.low.z, 0.5 * glm::dvec2(extent.low + extent.high),
          std::max(kMargin * std::max(side.x, side.y), kLeastVoxels * std::max(spacing.x, spacing.y))};
}

SweepPicture picture_of(const Region& inside, const Volume& source, const WindowLevel& window,
                        const SweepCut& cut, int side) {
  const auto at = [&](const Place& place, int x, int y) {
    const auto voxel = place.voxel(x, y);
    return voxel && inside.contains(*voxel);
  };
  return painted(source, window, cut, side, [&](const Place& place, Index3 voxel, int x, int y) {
    if (!inside.contains(voxel)) return std::pair(kSurfaceYellow, 0.0);
    const bool border =
        !at(place, x - 1, y) || !at(place, x + 1, y) || !at(place, x, y - 1) || !at(place, x, y + 1);
    return std::pair(kSurfaceYellow, border ? 1.0 : kTint);
  });
}

SweepPicture picture_of(const Agreement& agreement, const Volume& source, const WindowLevel& window,
                        const SweepCut& cut, int side) {
  return painted(source, window, cut, side, [&](const Place& /*place*/, Index3 voxel, int /*x*/, int /*y*/) {
    const double share = agreement.share(voxel);
    return std::pair(heat_colour(share), share > 0.0 ? kHeat : 0.0);
  });
}

SweepColour heat_colour(double share) {
  constexpr std::array<SweepColour, 6> kColours{
      {{68, 1, 84}, {65, 68, 135}, {42, 120, 142}, {34, 168, 132}, {122, 209, 81}, {253, 231, 37}}};
  const double at = std::clamp(share, 0.0, 1.0) * (kColours.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(at), kColours.size() - 2);
  SweepColour colour{};
  for (std::size_t c = 0; c < 3; ++c) {
    colour[c] = mixed(kColours[below][c], kColours[below + 1][c], at - static_cast<double>(below));
  }
  return colour;
}

double SweepScale::share(double value) const {
  if (!(high > low)) return 1.0;
  const double part = logarithmic ? std::log(std::max(value, low) / low) / std::log(high / low)
                                  : (value - low) / (high - low);
  return std::clamp(part, 0.0, 1.0);
}

SweepScale volume_scale(const Sweep& sweep) {
  SweepScale scale{0.0, 0.0, true};
  for (const SweepRun& run : sweep.runs) {
    if (run.volume_ml <= 0.0) continue;
    scale.low = scale.low == 0.0 ? run.volume_ml : std::min(scale.low, run.volume_ml);
    scale.high = std::max(scale.high, run.volume_ml);
  }
  return scale;
}

SweepScale dice_scale(const Sweep& sweep) {
  SweepScale scale{1.0, 0.0};
  for (const SweepRun& run : sweep.runs) {
    if (!run.dice || run.volume_ml <= 0.0) continue;
    scale.low = std::min(scale.low, *run.dice);
    scale.high = std::max(scale.high, *run.dice);
  }
  return scale;
}

}  // namespace tidemark::document
