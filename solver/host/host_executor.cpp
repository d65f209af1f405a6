#include "solver/host/host_executor.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "core/stopwatch.h"
#include "solver/host/page_code.h"
#include "solver/host/page_constraints.h"
#include "solver/host/page_view.h"
#include "solver/paging/validate.h"

namespace tidemark::solver {
namespace {

// Pages that a thread takes at a time.
constexpr std::int64_t kLongestPiece = 16;

// Bits for whole groups of rows_per_vector rows: a vector computes all of its rows or none.
Rows whole_vectors(Rows rows, int rows_per_vector) {
  if (rows_per_vector == 1) return rows;
  constexpr Rows kEven = 0x5555555555555555U;
  const Rows first = (rows | rows >> 1U) & kEven;
  return first | first << 1U;
}

void fill_rows(float* page, Rows rows, float value) {
  for (; rows != 0; rows &= rows - 1) {
    float* row = page + std::countr_zero(rows) * kPageSide;
    for (int x = 0; x < kPageSide; ++x) row[x] = value;
  }
}

}  // namespace

Result<PageKernels> HostExecutor::chosen_kernels() {
  const char* chosen = std::getenv("TIDEMARK_SIMD");
  auto kernels = select_page_kernels(chosen != nullptr ? chosen : "");
  if (!kernels) return fail(kernels.error().kind, "TIDEMARK_SIMD: {}", kernels.error().message);
  return kernels;
}

Result<std::unique_ptr<Executor>> HostExecutor::create(std::shared_ptr<const Volume> source,
                                                       const Parameters& parameters,
                                                       const ExecutorOptions& options) {
  auto kernels = chosen_kernels();
  if (!kernels) return pass_on(kernels);
  std::unique_ptr<HostExecutor> executor(
      new HostExecutor(std::move(source), parameters, options, std::move(*kernels)));
  return executor;
}

HostExecutor::HostExecutor(std::shared_ptr<const Volume> source, const Parameters& parameters,
                           const ExecutorOptions& options, PageKernels kernels)
    : ExecutorBase(std::move(source), parameters),
      constants_(model_.constants<float>()),
      kernels_(std::move(kernels)),
      threads_(std::make_unique<ThreadPool>(options.threads)),
      pages_({source_->geometry, model_, speed_, constraints_}, *threads_, options.memory_budget_bytes),
      quiet_(pages_, options.skip_quiet_pages),
      edits_({source_->geometry, model_, speed_, constraints_}, pages_, quiet_) {
  for (int member = 0; member < threads_->threads(); ++member) tiles_.push_back(std::make_unique<Tile>());
  updates_.resize(tiles_.size());
}

Status HostExecutor::restore(const Field& phi) {
  begin_window();
  return edits_.restore(phi);
}

Result<Field> HostExecutor::snapshot() const {
  quiet_.note_changes();
  return pages_.copy();
}

Status HostExecutor::paint(const Sphere& sphere, Brush brush) {
  restart_watch(kPageVoxels);
  window_begins_ = true;
  return edits_.paint(sphere, brush);
}

Status HostExecutor::drive(const Parameters& parameters, std::shared_ptr<const SpeedFunction> given) {
  auto drive = drive_with(parameters, std::move(given));
  if (!drive) return pass_on(drive);
  TIDEMARK_TRY(pages_.keep_advection(drive->used->advects()));
  take(std::move(*drive));
  constants_ = model_.constants<float>();
  begin_window();
  quiet_.wake_all();
  pages_.refill();
  return {};
}

Status HostExecutor::set_constraints(std::shared_ptr<const Constraints> constraints) {
  if (constraints != nullptr) {
    TIDEMARK_TRY(check_fits(*constraints));
  }
  const std::shared_ptr<const Constraints> former = std::exchange(constraints_, std::move(constraints));
  pages_.link_constraints();
  begin_window();
  quiet_.wake_all();
  if (Status limited = edits_.constrain(); !limited) {
    constraints_ = former;
    pages_.link_constraints();
    return limited;
  }
  return {};
}

// Takes a page to the limits of its constraints; `before` is phi two steps ago.
void HostExecutor::limit(const PageInfo& info, const float* before, float* phi, RowMasks& masks,
                         PageResult& result) const {
  if (!constrain(info.constraints, phi)) return;
  masks = masks_of(phi, info.valid[0], info.padding, constants_.band);
  if (next_step_is_measured()) measure_again(info, before, phi, constants_.near, result);
}

// Computes those rows of an active page from the current buffer into the other one and writes its code;
// returns the number of voxels computed.
std::int64_t HostExecutor::update_page(std::size_t index, RowWork work, const PagePrefetch& ahead,
                                       Tile& tile) {
  const PhysicalPage page = quiet_.active()[index];
  HostFields& fields = pages_.fields();
  PageInfo& info = fields.info(page);
  const int next = 1 - pages_.current();
  const Rows rows = whole_vectors(work.compute, kernels_.rows_per_vector);
  work.inside &= ~rows;
  work.outside &= ~rows;

  // Rows that stay constant are written only where the other buffer does not hold the constant yet.
  float* phi = fields.phi(next, page);
  RowMasks& masks = fields.masks(next, page);
  fill_rows(phi, work.inside & ~masks.inside, constants_.band);
  fill_rows(phi, work.outside & ~masks.outside, -constants_.band);

  float before[kPageVoxels];
  if (info.constraints != nullptr) std::copy_n(phi, kPageVoxels, before);
  PageResult result;
  if (rows != 0) {
    PageJob job;
    job.fields = &fields;
    job.buffer = pages_.current();
    job.info = &info;
    job.tile = &tile;
    job.data_motion = fields.data_motion(page);
    job.advection = fields.advection(page);
    job.next = phi;
    job.rows = rows;
    job.ahead = &ahead;
    job.constants = &constants_;
    kernel_(job, result);
  } else {
    PagePrefetch::Turns(ahead, 1).go_on();
  }
  masks = result.masks;
  masks.inside |= work.inside;
  masks.inside_first |= work.inside;
  masks.inside_last |= work.inside;
  masks.outside |= work.outside;
  masks.outside_first |= work.outside;
  masks.outside_last |= work.outside;
  masks.add_padding(info.padding);
  result.content += 2.0F * constants_.near *
                    static_cast<float>(std::popcount(work.inside & ~info.padding) * int{info.valid[0]});
  if (info.constraints != nullptr) limit(info, before, phi, masks, result);

  info.change += result.largest_change;
  if (next_step_is_measured()) {
    info.content += result.content;
    info.near_voxels += result.near_voxels;
    ++info.samples;
  }
  std::uint8_t code = pages_.requests(page, next);
  if (info.change > kQuietChange && !info.woke_neighbours) code |= kMovedBit;
  codes_[index] = code;
  return std::popcount(rows & ~info.padding) * std::int64_t{info.valid[0]};
}

// Updates the active pages [begin, end), at most kLongestPiece; returns the number of voxels computed.
std::int64_t HostExecutor::update_piece(std::int64_t begin, std::int64_t end, int member) {
  // What is to do is found for all of them first: the masks that this waits for then come at the same time.
  const std::vector<PhysicalPage>& active = quiet_.active();
  const HostFields& fields = pages_.fields();
  RowWork work[kLongestPiece];
  for (std::int64_t i = begin; i < end; ++i) {
    work[i - begin] =
        find_row_work(fields, pages_.current(), fields.info(active[static_cast<std::size_t>(i)]));
  }
  constexpr std::int64_t kPrefetchAhead = 5;  // pages; from 2 to 12 it makes no difference (measured)
  // Asking for neighbours, too, makes a step 7 % longer while the surface is small, and 7 % shorter when it
  // has 6,600 pages, 40 MB of values (measured).
  constexpr std::int64_t kMostPagesInCache = 3000;
  const std::int64_t count = std::ssize(active);
  // Not beyond the thread's own share, nor beyond a piece of another's: what lies there is being written.
  ThreadPool::Range reach = threads_->share(count, member);
  if (begin < reach.begin || end > reach.end) reach = {begin, end};
  Tile& tile = *tiles_[static_cast<std::size_t>(member)];
  const std::int64_t stride = goes_back() ? -1 : 1;
  std::int64_t updates = 0;
  std::int64_t i = goes_back() ? end - 1 : begin;
  for (std::int64_t left = end - begin; left > 0; --left, i += stride) {
    const std::int64_t then = i + stride * kPrefetchAhead;
    PagePrefetch ahead;
    if (then >= reach.begin && then < reach.end) {
      const PhysicalPage page = active[static_cast<std::size_t>(then)];
      ahead.add_values(fields, page);
      if (count > kMostPagesInCache) ahead.add_neighbours(fields, pages_.current(), page);
    }
    updates += update_page(static_cast<std::size_t>(i), work[i - begin], ahead, tile);
  }
  return updates;
}

void HostExecutor::step() {
  const bool motion = next_step_is_measured();
  kernel_ =
      kernels_
          .kernels[model_.parameters().scheme == Scheme::paper ? 1 : 0]
                  [model_.spacing() == glm::dvec3(1.0) ? 0 : 1][motion ? 1 : 0][speed_->advects() ? 1 : 0];
  std::fill(updates_.begin(), updates_.end(), 0);
  const std::int64_t count = std::ssize(quiet_.active());
  // Short enough that no thread waits for another's last piece for long.
  const std::int64_t grain = std::clamp<std::int64_t>(count / (8 * threads_->threads()), 1, kLongestPiece);
  threads_->for_each(
      count, grain,
      [&](std::int64_t begin, std::int64_t end, int member) {
        // Once a piece: the threads' sums share a cache line.
        updates_[static_cast<std::size_t>(member)] += update_piece(begin, end, member);
      },
      goes_back() ? ThreadPool::Direction::backward : ThreadPool::Direction::forward);
  pages_.swap_buffers();
  quiet_.computed();
}

// After a step: grants the requests, frees pages that have become constant, wakes neighbours of pages that
// move. Fails when the budget does not allow a page; what could be done is done then.
Status HostExecutor::maintain() {
  Status result;
  for (std::size_t i = 0; i < codes_.size(); ++i) {
    const std::uint8_t code = codes_[i];
    if (code == 0) continue;
    const PhysicalPage page = quiet_.active()[i];
    if ((code & kRequestBits) != 0 && result) result = pages_.grant_requests(page, code);
    if ((code & kMovedBit) != 0) quiet_.wake_around(page);
    if ((code & kReleaseBit) != 0) pages_.release_if_surrounded(page);
  }
  pages_.fill_new_pages();
  return result;
}

// What moved so far no longer counts.
void HostExecutor::begin_window() {
  restart_watch(kPageVoxels);
  quiet_.begin_window();
  window_begins_ = false;
}

// Ends the window of steps over which motion is summed up, when this step does: judges convergence and which
// pages are quiet. Returns whether it did.
bool HostExecutor::finish_window() {
  if (++steps_in_window_ < kConvergenceWindow) return false;
  quiet_.show(watch_);
  watch_.end_window();
  quiet_.judge();
  steps_in_window_ = 0;
  quiet_.begin_window();
  return true;
}

Result<AdvanceReport> HostExecutor::advance(const Advance& run) {
  steps_of_last_run_ = 0;
  if (pages_.needs_activation()) {
    TIDEMARK_TRY(pages_.activate_all());
  }
  if (window_begins_) begin_window();
  return run_steps(run, [this](AdvanceReport& report) -> Result<bool> {
    const Stopwatch list;
    quiet_.refresh_active();
    codes_.resize(quiet_.active().size());
    report.paging_seconds += list.seconds();
    step();
    for (const std::int64_t updates : updates_) report.voxel_updates += updates;

    const Stopwatch paging;
    const Status maintained = maintain();
    const bool window_ended = finish_window();
    report.paging_seconds += paging.seconds();
    if (!maintained) {
      return fail(maintained.error().kind, "after {} steps: {}", report.steps, maintained.error().message);
    }
    return window_ended;
  });
}

MemoryReport HostExecutor::memory() const {
  MemoryReport report;
  report.resident_pages = pages_.table().resident();
  report.peak_resident_pages = pages_.memory().peak_resident();
  report.quiet_pages = quiet_.count();
  report.state_bytes =
      pages_.state_bytes() + quiet_.state_bytes() + static_cast<std::int64_t>(codes_.capacity());
  report.peak_state_bytes = report.state_bytes;  // pages are kept for reuse, so memory never shrinks
  report.source_bytes = pages_.drive_bytes();
  report.page_shape = kDefaultPageShape;
  return report;
}

bool HostExecutor::page_view(PageView& view) const {
  quiet_.note_changes();
  view.memory = &pages_.memory();
  view.band = constants_.band;
  view.pages = pages_.phi(0);
  view.stride = HostFields::kFloatsPerPage;
  return true;
}

Status HostExecutor::validate() const {
  TIDEMARK_TRY(pages_.validate());
  TIDEMARK_TRY(quiet_.validate());
  const Result<Field> copy = snapshot();
  TIDEMARK_TRY(copy);
  TIDEMARK_TRY(pages_.validate(*copy));
  return tidemark::solver::validate(*copy);
}

}  // namespace tidemark::solver
