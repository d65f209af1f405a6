// The pictures of a sweep: the same slice with the inside of each run, and the agreement of all.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "core/region.h"
#include "core/volume.h"
#include "document/sweep.h"

namespace tidemark::document {

// A square of one slice (of constant k).
struct SweepCut {
  std::int64_t k = 0;
  glm::dvec2 middle{0.0};  // (i, j), in voxels
  double side_mm = 1.0;
};

// The slice of which most is inside in at least a quarter of the runs, and the square around that with half
// of it as a margin. Where nothing is inside, the middle slice as a whole.
[[nodiscard]] SweepCut sweep_cut(const Agreement& agreement, const Geometry& grid);

// `side` x `side` pixels of red, green, blue and opacity (255), rows from the top. The patient's right, front
// and head are to the left and above, as far as the slice shows them.
struct SweepPicture {
  int side = 0;
  std::vector<std::uint8_t> pixels;
};
// The source in its window, with the inside tinted and outlined in the surface's yellow.
[[nodiscard]] SweepPicture picture_of(const Region& inside, const Volume& source, const WindowLevel& window,
                                      const SweepCut& cut, int side);
// The source, with the share of runs that have a voxel inside in heat_colour(); no colour where none has.
[[nodiscard]] SweepPicture picture_of(const Agreement& agreement, const Volume& source,
                                      const WindowLevel& window, const SweepCut& cut, int side);

// From dark blue by green to yellow, for `share` from 0 to 1: told apart by lightness alone, too.
using SweepColour = std::array<std::uint8_t, 3>;
[[nodiscard]] SweepColour heat_colour(double share);

// The values of a sweep from the least to the largest, for colours.
struct SweepScale {
  double low = 0.0;
  double high = 0.0;
  bool logarithmic = false;  // one surface that has filled the volume leaves the others their colours

  [[nodiscard]] double share(double value) const;  // 0 to 1
};
// Of surfaces that have not vanished.
[[nodiscard]] SweepScale volume_scale(const Sweep& sweep);  // in ml
[[nodiscard]] SweepScale dice_scale(const Sweep& sweep);

}  // namespace tidemark::document
