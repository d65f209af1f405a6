// The outcome of a level set: decided in one place for the desktop and the command line.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "solver/field.h"
#include "solver/parameters.h"
#include "solver/speed/speed_function.h"

namespace tidemark::document {

enum class Outcome {
  unfinished,      // it moves, or no step was computed
  converged,       // it has stopped moving
  vanished,        // nothing is inside any more, but for a few voxels that have stopped
  seeded_outside,  // the same, and D > 0 nowhere where it began
  filled_volume,   // everything is inside, but for islands
};

// As figures for programs name it: "seeded_outside".
std::string_view name_of(Outcome outcome);
// Whether steps have something to compute. Where they have not, their pace says nothing.
bool has_surface(Outcome outcome);

// A level set of which steps have been computed.
struct EvolvedSurface {
  const solver::Field& phi;
  std::int64_t voxels_inside = 0;
  std::int64_t steps = 0;
  bool stopped = false;                          // AdvanceReport::converged
  const solver::Field* start = nullptr;          // before the first step; null: not known
  const Volume& source;                          // as the level set sees it
  const solver::Parameters& parameters;          // the present ones
  const solver::SpeedFunction* speed = nullptr;  // null: the parameters' tent
};
Outcome outcome_of(const EvolvedSurface& surface);

// The epsilon to try where noise has stopped the surface inside of like tissue, because epsilon is narrower
// than the tissue's values vary; unset: it is no such surface.
//
// Looks at the voxels two away from the surface on its outer side. Like tissue is where the mean of a voxel
// and its 26 neighbours is within T -+ epsilon: without noise the surface would be drawn there. At the border
// of another tissue there is next to none of it. What is offered is twice the root mean square of I - T in
// such voxels.
std::optional<double> wider_range(const EvolvedSurface& surface);

}  // namespace tidemark::document
