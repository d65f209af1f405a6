// Strokes as a user paints them on a study.
#pragma once

#include "solver/speed/strokes.h"
#include "studies.h"

namespace tidemark {

// Discs in slices: two inside, near the start, and three outside. A later one is the stroke more that
// `more` counts.
[[nodiscard]] std::shared_ptr<const solver::Strokes> strokes_on(const engine::LoadedStudy& study,
                                                                int more = 0);

}  // namespace tidemark
