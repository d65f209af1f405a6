// The diameters of a region, and how far it reaches along its main axes.
#pragma once

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "core/region.h"

namespace tidemark::imaging {

// A straight line between two points of the patient (LPS, mm).
struct Chord {
  glm::dvec3 from_mm{0.0};
  glm::dvec3 to_mm{0.0};

  [[nodiscard]] double length_mm() const { return glm::distance(from_mm, to_mm); }
};

// Ends lie on the middles of the voxel faces where the region ends.
struct Diameters {
  Chord longest;
  // The longest one in a slice, of the slices that lie most nearly axial, and the longest at right angles to
  // it in the same slice, from border to border: the two diameters of RECIST 1.1.
  Chord in_slice;
  Chord across;
  glm::dvec3 centre_mm{0.0};  // the mean of the voxels' centres (LPS)
  // Unit vectors in LPS, the one along which the voxels spread most first, and how far the region reaches
  // along each.
  glm::dmat3 main_axes{1.0};
  glm::dvec3 reach_mm{0.0};
};

// None: the region is empty.
[[nodiscard]] std::optional<Diameters> diameters_of(const Region& region, const Geometry& grid);

}  // namespace tidemark::imaging
