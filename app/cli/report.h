// The figures of a run, for people and for programs.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/console.h"
#include "core/region.h"
#include "document/coarse_levels.h"
#include "document/drive.h"
#include "document/outcome.h"
#include "solver/executor.h"
#include "solver/statistics.h"
#include "solver/surface_agreement.h"

namespace tidemark::cli {

// What a refined mask has become.
struct MaskChange {
  std::int64_t added = 0;  // voxels
  std::int64_t removed = 0;
  double added_ml = 0.0;
  double removed_ml = 0.0;
};
[[nodiscard]] MaskChange change_between(const Region& before, const Region& after, const Geometry& grid);

// The figures of a run of the solver.
struct RunFigures {
  std::string executor;
  int threads = 1;
  Geometry geometry;
  std::string modality;
  std::string unit;  // of the values
  std::string description;
  std::string series_uid;            // empty when the format has none
  std::vector<std::string> changes;  // found and changed by loading
  std::string start;
  std::shared_ptr<const document::Drive> drive;  // null: the tent alone
  solver::Parameters parameters;
  std::optional<double> smooth_mm;
  double band = 0.0;
  double time_step = 0.0;
  std::vector<document::CoarseRun> coarse_runs;  // before `advance`; empty: none
  solver::AdvanceReport advance;
  document::Outcome outcome = document::Outcome::unfinished;
  std::optional<double> wider_range;
  std::optional<glm::dvec3> moves_at;  // a place on the surface that still moved, in voxels
  solver::MemoryReport memory;
  solver::SurfaceStatistics surface;
  std::optional<double> dice;                             // against a truth
  std::optional<solver::SurfaceDistance> truth_distance;  // to it
  std::optional<MaskChange> change;                       // of a mask that it began with
};

// What happened to a surface that is of no use, and what to try; empty: nothing of the kind.
[[nodiscard]] std::string advice_on(const RunFigures& figures);

[[nodiscard]] double steps_per_second(const solver::AdvanceReport& report);
[[nodiscard]] double voxel_updates_per_second(const solver::AdvanceReport& report);

// Bytes of solver state, at their most, by voxel of the pages that were resident then.
[[nodiscard]] double bytes_per_resident_voxel(const solver::MemoryReport& memory);

// The object of --stats; its keys are a contract (they may grow in number).
[[nodiscard]] Json to_json(const RunFigures& figures);
[[nodiscard]] Json grid_json(const Geometry& geometry);  // size, spacing_mm

// The same in a few lines.
void say(Console& console, const RunFigures& figures);

}  // namespace tidemark::cli
