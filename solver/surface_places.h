// Places on the surface: near a given one, and spread over it or over its outline in a plane.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "solver/field.h"

namespace tidemark::solver {

// In voxel coordinates of phi, integers at centres, as all places here. Interpolated trilinearly; `place`
// lies inside of the grid.
[[nodiscard]] double phi_at(const Field& phi, glm::dvec3 place);

// The place on the surface that a walk along `way` (voxel coordinates) and against it finds first, at most
// `reach` lengths of it away.
[[nodiscard]] std::optional<glm::dvec3> surface_along(const Field& phi, glm::dvec3 place, glm::dvec3 way,
                                                      double reach);
// The place on the surface nearest to one that is at most `reach` voxels away: along the gradient of phi in
// the band, else along the axes and diagonals of the grid.
[[nodiscard]] std::optional<glm::dvec3> surface_near(const Field& phi, glm::dvec3 place, double reach);

// The part of the patient that is no farther than `reach_mm` from the plane normal . p = offset_mm (LPS).
struct PlaneSlab {
  glm::dvec3 normal{0.0, 0.0, 1.0};
  double offset_mm = 0.0;
  double reach_mm = 0.5;

  bool operator==(const PlaneSlab&) const = default;
};

// Places on the surface, about that far apart; without a slab on all of it.
[[nodiscard]] std::vector<glm::dvec3> surface_places(const Field& phi, const std::optional<PlaneSlab>& slab,
                                                     double apart_mm, const std::stop_token& stop = {});

// The same in pages of those numbers.
[[nodiscard]] std::vector<glm::dvec3> surface_places_in(const Field& phi, std::span<const std::int64_t> pages,
                                                        double apart_mm, const std::stop_token& stop = {});

}  // namespace tidemark::solver
