// A sweep: level sets from one start, with one or two of the parameters over their values.
//
// Each run is computed by the host executor on one thread, several at once, and leads to the same bits as a
// single run from there with its parameters.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/region.h"
#include "document/agreement.h"
#include "document/outcome.h"
#include "document/recipe.h"
#include "document/sweep_axis.h"

namespace tidemark::document {

// The common part of all runs. All of it is shared, and nothing is copied.
struct SweepStart {
  std::shared_ptr<const Volume> source;                // as the level set sees it
  std::shared_ptr<const solver::Field> phi;            // before the first step
  std::shared_ptr<const solver::MotionLimit> limit;    // of a start that is refined; null: none
  solver::Parameters parameters;                       // of what is not swept
  std::shared_ptr<const Drive> drive;                  // null: the tent, and nothing that holds the surface
  std::shared_ptr<const solver::SpeedFunction> speed;  // made from `drive`; null: the tent, or not yet made
};
// Of a recipe: its start, with the edits before its first step. Fails as evolve() does.
Result<SweepStart> sweep_start(const Recipe& recipe, std::shared_ptr<const Volume> volume,
                               const Progress& progress = {});

struct SweepOptions {
  std::vector<SweepAxis> axes;                    // one or two
  std::int64_t steps = solver::kMostStepsToRest;  // of a run, at most
  bool until_converged = true;
  std::shared_ptr<const Region> truth;                                 // null: none
  int threads = 0;                                                     // 0: all processors of this process
  std::int64_t memory_budget_bytes = solver::default_memory_budget();  // for all runs and their results
  bool skip_quiet_pages = true;
};

struct SweepRun {
  solver::Parameters parameters;
  std::shared_ptr<const Drive> drive;  // null: as of SweepStart
  std::int64_t steps = 0;
  bool converged = false;
  Outcome outcome = Outcome::unfinished;
  double volume_ml = 0.0;
  std::optional<double> dice;  // with a truth
  Region inside;
  std::string problem;  // why it has no end, for lack of memory; empty: it has
};

struct Sweep {
  std::vector<SweepAxis> axes;
  std::vector<SweepRun> runs;  // the first axis fastest
  Agreement agreement;         // of the runs that have an end

  [[nodiscard]] int columns() const { return axes.front().count; }
  [[nodiscard]] int rows() const { return axes.size() < 2 ? 1 : axes.back().count; }
  [[nodiscard]] const SweepRun& at(int column, int row) const {
    return runs[static_cast<std::size_t>(row * columns() + column)];
  }
};

// Computes all runs. One that needs more memory than its share of the budget is left out and says so. Fails
// (ErrorKind::usage) as check() of axes does, (ErrorKind::capability) when the budget does not hold the
// results or no run has an end, (ErrorKind::cancelled).
Result<Sweep> run_sweep(const SweepStart& start, const SweepOptions& options, const Progress& progress = {});

}  // namespace tidemark::document
