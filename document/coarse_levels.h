// Coarse to fine: a start that has come to rest on coarser grids before its first step.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "document/start.h"

namespace tidemark::document {

// What a level set that begins coarse to fine is made from, on the volume's own grid.
struct CoarseInputs {
  const Volume& source;                                // as the level set sees it
  std::shared_ptr<const solver::SpeedFunction> speed;  // never null
  std::shared_ptr<const solver::Constraints> marks;    // walls and anchors; null: none
  solver::Parameters parameters;
  solver::ExecutorKind kind = solver::ExecutorKind::automatic;
  solver::ExecutorOptions options;
  double band = 0.0;  // of the result, as its pages
  Index3 page_shape = kDefaultPageShape;
};

// A run on a coarser grid, to rest or to kMostCoarseSteps.
inline constexpr std::int64_t kMostCoarseSteps = 2000;
struct CoarseRun {
  Index3 size{0};  // of the grid
  solver::AdvanceReport advance;
};

struct CoarseStart {
  solver::Field phi;
  std::vector<CoarseRun> runs;  // the coarsest first
};

// phi after the coarser of `start.levels`. Unset where a coarse grid holds nothing of the start, or its
// surface vanishes: what is so small begins on the volume's own grid. Fails (ErrorKind::usage) as begin()
// does, for a saved level set and for the raw tent; (ErrorKind::capability) as executors do;
// (ErrorKind::cancelled).
Result<std::optional<CoarseStart>> run_coarse_levels(const Start& start, const CoarseInputs& inputs,
                                                     const Progress& progress);

}  // namespace tidemark::document
