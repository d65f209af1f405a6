// The state of a case, as values for those who show it.
#pragma once

#include <QString>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "document/curve.h"
#include "document/drive.h"
#include "document/labels.h"
#include "document/leak.h"
#include "document/outcome.h"
#include "document/region_statistics.h"
#include "engine/case_history.h"
#include "engine/surface_maps.h"
#include "solver/balance.h"
#include "solver/executor.h"
#include "solver/statistics.h"

namespace tidemark::solver {
class MotionLimit;
}

namespace tidemark::engine {

// A leak, as the watch has seen it.
struct LeakAlarm {
  document::Leak leak;
  std::int64_t step = 0;    // when it was seen
  std::int64_t before = 0;  // the last step that was seen before the front was in the neck
};

// A case after the engine's last job for it.
struct CaseState {
  solver::Parameters parameters;
  std::int64_t step = 0;        // since the start
  bool begun = false;           // there is a surface
  std::int64_t steered_at = 0;  // the step of the last edit since the start, else 0
  std::uint64_t steered = 0;    // how many edits there were since the start
  bool playing = false;
  bool converged = false;
  document::Outcome outcome = document::Outcome::unfinished;  // as of the last measurement
  std::optional<double> wider_range;      // the epsilon to try: see wider_range(); measured when it rests
  std::shared_ptr<const LeakAlarm> leak;  // why it has paused; null: for no leak, or it has gone on since
  double time_step = 0.0;
  double band = 2.5;
  document::Drive drive;
  std::shared_ptr<const solver::SpeedFunction> speed;  // that drives it now, or will; null: the tent
  bool speed_waits = false;                            // another one is being made
  bool lacks_speed = false;  // the drive's is not there: nothing drives it, and `speed` is null
  std::shared_ptr<const solver::Constraints> constraints;  // of the drive and of a start; null: none
  double smoothed_mm = 0.0;
  std::optional<double> smoothing;       // to that many mm, on its way
  std::shared_ptr<const Volume> source;  // as the level set sees it: smoothed by that much
  QString executor;                      // "host", "compute", "stream"
  double pace = 0.0;              // the most steps a second that it plays at; 0: as many as can be computed
  double steps_per_second = 0.0;  // while it plays, in the last second: steps by time, pictures included
  double solver_steps_per_second = 0.0;  // in the solver's own time
  solver::MemoryReport memory;
  std::shared_ptr<const solver::Field> phi;  // at most a second old while it plays, else current
  std::shared_ptr<const std::vector<std::int64_t>> moving_pages;  // as of phi; see Executor::moving_pages()
  document::Curve curve;                                          // how it has developed since the start
  solver::SurfaceStatistics surface;                              // as of the last measurement
  std::optional<double> dice;         // against CaseProxy::truth(), as of the last measurement
  document::RegionStatistics inside;  // of the volume's values, under the surface; measured when it rests
  std::vector<document::Label> labels;
  std::vector<document::RegionStatistics> label_statistics;  // in the order of `labels`
  std::shared_ptr<const PagedBytes> label_voxels;            // null while there are none
  std::optional<document::Acceptance> acceptance;            // while it is the last change
  QString undo_text;                                         // which change undo takes back; empty: none
  QString redo_text;
  std::shared_ptr<const HistoryRows> history = std::make_shared<const HistoryRows>();  // never null
  std::uint64_t history_state = 0;  // of them, the present one or the one where the next begins
  std::optional<document::HistoryState> open_change;  // that goes on from it
  std::uint64_t edits = 0;                            // how much was done: grows with each edit
  std::uint64_t commands = 0;                         // the last that is carried out: CaseRunner::post()
  bool modified = false;                              // something would be lost
  QString start_text;                                 // how it began
  std::shared_ptr<const solver::MotionLimit> limit;   // of a mask that is refined; null: none
  SurfaceMap surface_map = SurfaceMap::none;          // that views show
};

// What the next step computes with; none without a surface that was measured, or where nothing drives it.
[[nodiscard]] std::optional<solver::StepInputs> step_inputs(const CaseState& state);

}  // namespace tidemark::engine
