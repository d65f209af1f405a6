// The interface of all executors: one level set, several ways to run it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "core/progress.h"
#include "core/volume.h"
#include "solver/field.h"
#include "solver/parameters.h"
#include "solver/speed/constraints.h"
#include "solver/speed/speed_function.h"
#include "solver/sphere.h"

namespace tidemark::gpu {
class Device;
}

namespace tidemark::solver {

struct PackedView;
struct PageView;
struct PassRecord;

// The end of a run of steps.
struct Advance {
  std::int64_t steps = 1;        // at most
  bool until_converged = false;  // stop when the surface has stopped moving (see kRestVolume)
  Progress progress = {};        // fraction = steps done / steps; cancelling keeps what was computed
};

// By default a run until the surface has stopped ends after so many steps all the same.
inline constexpr std::int64_t kMostStepsToRest = 20000;

// The surface has stopped when no page of it moves (solver/convergence.h). A page moves when its volume
// inside, a mean over kConvergenceWindow steps, has changed by more than this part of the page (1 voxel of
// 8^3) within the time below. Only what goes on in one direction counts: voxels that flicker do not. After a
// change of phi or of the parameters, what moved before no longer counts.
inline constexpr double kRestVolume = 1.0 / 512.0;
// By alpha, which counts as 1/4 at least: in this time a front with D = 1 passes so many smallest voxel
// spacings.
inline constexpr double kRestTime = 5.0;
inline constexpr int kConvergenceWindow = 16;
// A surface that moves more slowly here counts as resting here, in smallest voxel spacings a unit of time (a
// front with D = 1, alpha = 1 moves at 1).
inline constexpr double kConvergedSpeed = 0.01;
// A page may rest when phi changed by no more than this over such a window, beside the surface.
inline constexpr float kQuietChange = 1e-3F;

// The cost of a run of steps.
struct AdvanceReport {
  std::int64_t steps = 0;
  bool converged = false;       // as of the last full window
  double seconds = 0.0;         // wall time in the solver
  double paging_seconds = 0.0;  // of these, allocation, freeing and lists (compute: see time_paging)
  std::int64_t voxel_updates =
      0;                       // voxels really computed: quiet pages, clamped rows and padding do not count
  double surface_speed = 0.0;  // of the page that goes on fastest, in the last full window
  std::int64_t moving_pages = 0;  // pages in which the surface still moved then
};

struct MemoryReport {
  std::int64_t resident_pages = 0;
  std::int64_t peak_resident_pages = 0;  // since phi was last replaced
  std::int64_t quiet_pages = 0;          // resident, but not computed at present
  // phi, tables and lists as allocated, and on the GPU what drives and holds the surface, but for a source in
  // one texture.
  std::int64_t state_bytes = 0;
  std::int64_t peak_state_bytes = 0;
  std::int64_t source_bytes = 0;  // the source beside resident pages
  Index3 page_shape{0};
};

class Executor {
 public:
  virtual ~Executor() = default;
  [[nodiscard]] virtual std::string_view name() const = 0;

  // Edits (restore(), paint() and set_constraints()) leave phi as before where they fail. They are done as
  // soon as there is room for what they change: a page beside it that finds none is asked for again by the
  // next advance(), which fails where there still is none.
  //
  // Replaces phi. Fails (ErrorKind::usage) when the grid or the band is not this level set's, and
  // (ErrorKind::capability) when the memory budget does not allow it.
  virtual Status restore(const Field& phi) = 0;
  // Fails (ErrorKind::capability) when a graphics driver has lost its context, and phi with it.
  [[nodiscard]] virtual Result<Field> snapshot() const = 0;

  // phi = max(phi, d) to add or min(phi, -d) to erase, d the signed distance to the sphere. Wakes what it
  // touches. Fails (ErrorKind::capability) when the memory budget is reached.
  virtual Status paint(const Sphere& sphere, Brush brush) = 0;

  // Takes effect with the next step and wakes every page. The band W cannot change in mid-run.
  virtual Status set_parameters(const Parameters& parameters) = 0;
  [[nodiscard]] virtual const Parameters& parameters() const = 0;

  // What drives the surface; null: the tent of the parameters on the source. Takes effect with the next step
  // and wakes every page. Fails (ErrorKind::capability) when the memory budget does not allow it; the former
  // one then goes on.
  virtual Status set_speed(std::shared_ptr<const SpeedFunction> speed) = 0;
  // What set_speed() was given, as it follows the surface now.
  [[nodiscard]] virtual const std::shared_ptr<const SpeedFunction>& speed() const = 0;

  // Walls and anchors; null: none. phi takes their limits at once, and keeps to them in every step, edit and
  // restore(). Fails (ErrorKind::usage) when they are on another grid, (ErrorKind::capability) when the
  // memory budget is reached.
  virtual Status set_constraints(std::shared_ptr<const Constraints> constraints) = 0;
  [[nodiscard]] virtual const std::shared_ptr<const Constraints>& constraints() const = 0;

  // Computes steps. Fails (ErrorKind::capability) when the memory budget is reached: every step up to there
  // is complete and kept. Cancelling is not a failure: the report says how many steps were done.
  virtual Result<AdvanceReport> advance(const Advance& run) = 0;
  // How many steps the last advance() computed, also if it failed.
  [[nodiscard]] virtual std::int64_t steps_of_last_run() const = 0;

  [[nodiscard]] virtual MemoryReport memory() const = 0;
  // The virtual pages that are resident, but not computed at present. Fails as snapshot() does.
  [[nodiscard]] virtual Result<std::vector<std::int64_t>> quiet_pages() const = 0;
  // The virtual pages in which the surface still moved in the last full window. Fails as snapshot() does.
  [[nodiscard]] virtual Result<std::vector<std::int64_t>> moving_pages() const = 0;
  // Shows where phi lies on the GPU (solver/gl/packed_view.h), with the executor's context current. Returns
  // false where it does not lie on one, or cannot be read there.
  virtual bool packed_view(PackedView& /*view*/) { return false; }
  // Shows where phi lies in the processor's memory (solver/host/page_view.h). Returns false where it does not
  // lie there in pages.
  [[nodiscard]] virtual bool page_view(PageView& /*view*/) const { return false; }

  // What the passes make of a virtual page in the next step, from phi to its message
  // (solver/stream/pass_record.h). Nothing changes by it. Fails (ErrorKind::usage) when there is no such
  // page, (ErrorKind::capability) where no passes are run, and as snapshot() does.
  [[nodiscard]] virtual Result<PassRecord> record_step(std::int64_t page);

  // Checks the invariants of the executor's own tables, and of phi; the error says which one is broken.
  [[nodiscard]] virtual Status validate() const = 0;

  [[nodiscard]] virtual double band() const = 0;       // W as resolved
  [[nodiscard]] virtual double time_step() const = 0;  // of the next step, in units of time
};

// Half of the memory that this process may use (machine_memory()): the rest is for the study, pictures, the
// history and other programs.
std::int64_t default_memory_budget();

struct ExecutorOptions {
  int threads = 0;                                             // 0: all processors of this process
  std::int64_t memory_budget_bytes = default_memory_budget();  // for state and source beside the pages
  bool skip_quiet_pages = true;

  // For executors on a GPU: the context to use (else each makes its own), messages of the driver, and the
  // shape of a page where the executor leaves a choice.
  std::shared_ptr<gpu::Device> device = nullptr;
  bool debug = false;
  bool time_paging = false;  // find out paging_seconds by waiting between some dispatches, which costs time
  Index3 page_shape = kDefaultPageShape;
};

// automatic: compute on a GPU whose driver passes a trial (solver/trial.h), else host.
enum class ExecutorKind { automatic, host, compute, stream, reference };
// "auto", or what Executor::name() says; unset for anything else.
std::optional<ExecutorKind> executor_named(std::string_view name);

// A level set on `source`, everywhere outside at first. `source` is kept. Fails (ErrorKind::usage) on
// parameters that check() refuses, (ErrorKind::capability) when the machine cannot run the executor, or a GPU
// computes the trial wrongly.
Result<std::unique_ptr<Executor>> make_executor(ExecutorKind kind, std::shared_ptr<const Volume> source,
                                                const Parameters& parameters,
                                                const ExecutorOptions& options = {});

}  // namespace tidemark::solver
