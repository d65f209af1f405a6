#include "solver/compute/compute_executor.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/common.hpp>
#include <utility>

#include "core/stopwatch.h"
#include "solver/convergence.h"
#include "solver/gl/packed_view.h"
#include "solver/paging/validate.h"

namespace tidemark::solver {
namespace {

// Runs of steps, and pieces of a step, take about this long.
constexpr double kSecondsPerRun = 0.008;
// With ExecutorOptions::time_paging one window of so many is timed: to wait after each dispatch would time
// the waiting.
constexpr std::int64_t kWindowsPerTiming = 8;

// "F(0) F(1) ... ", for a macro that applies another one.
std::string repeated(std::int64_t count) {
  std::string text;
  for (std::int64_t i = 0; i < count; ++i) text += fmt::format("F({}) ", i);
  return text;
}

}  // namespace

Result<std::unique_ptr<Executor>> ComputeExecutor::create(std::shared_ptr<const Volume> source,
                                                          const Parameters& parameters,
                                                          const ExecutorOptions& options) {
  std::shared_ptr<gpu::Device> device = options.device;
  if (device == nullptr) {
    auto made = gpu::Device::create_headless({gpu::GlVersion::gl45, options.debug});
    if (!made) return pass_on(made);
    device = std::move(*made);
  }
  if (!device->capabilities().at_least(4, 5)) {
    return fail(ErrorKind::capability, "the compute executor needs OpenGL 4.5; {} offers {}.{}",
                device->capabilities().renderer, device->capabilities().major, device->capabilities().minor);
  }
  TIDEMARK_TRY(device->make_current());
  std::unique_ptr<ComputeExecutor> executor(
      new ComputeExecutor(std::move(device), std::move(source), parameters, options));
  TIDEMARK_TRY(executor->compile());
  const Field nothing =
      Field::empty(executor->source_->geometry, executor->band(), executor->layout_.layout().page_shape());
  TIDEMARK_TRY(executor->restore(nothing));
  return executor;
}

ComputeExecutor::ComputeExecutor(std::shared_ptr<gpu::Device> device, std::shared_ptr<const Volume> source,
                                 const Parameters& parameters, const ExecutorOptions& options)
    : GlExecutor(std::move(device), std::move(source), parameters, options, options.page_shape) {}

Status ComputeExecutor::compile() {
  TIDEMARK_TRY(make_textures());
  struct Kernel {
    gpu::Program& program;
    const char* path;
  };
  gpu::Defines defines = layout_.defines();
  // Invocations that look after a page: on a software driver, one vector of them.
  defines.emplace_back("MAINTAINERS", software() ? "8" : "32");
  for (const Kernel& kernel :
       {Kernel{maintain_, "maintain"}, Kernel{find_quiet_pages_, "find_quiet_pages"},
        Kernel{check_convergence_, "check_convergence"}, Kernel{rebuild_, "rebuild"}}) {
    auto program =
        gpu::Program::compute(*device_, fmt::format("solver/compute/{}.comp", kernel.path), defines);
    if (!program) return pass_on(program);
    kernel.program = std::move(*program);
  }
  auto readback = gpu::Readback::create(*device_, sizeof(ComputeControl), "control on its way");
  if (!readback) return pass_on(readback);
  readback_ = std::move(*readback);
  return compile_for_drive();
}

Status ComputeExecutor::compile_for_drive() {
  TIDEMARK_TRY(compile_paint());
  return compile_update();
}

bool ComputeExecutor::shared_apron() const {
  const char* chosen = std::getenv("TIDEMARK_APRON");
  return chosen == nullptr ? !software() : std::string_view(chosen) == "shared";
}

Status ComputeExecutor::compile_paint() {
  gpu::Defines defines = layout_.defines();
  gpu::add(defines, drive_textures_.constraint_defines());
  if (defines == paint_defines_) return {};
  auto paint = gpu::Program::compute(*device_, "solver/compute/paint.comp", defines);
  if (!paint) return pass_on(paint);
  paint_ = std::move(*paint);
  paint_defines_ = std::move(defines);
  return {};
}

Status ComputeExecutor::compile_update() {
  gpu::Defines defines = layout_.defines();
  gpu::add(defines, step_defines(model_));
  gpu::add(defines, drive_textures_.defines());
  // A software driver runs the columns along x in the lanes of a vector, and its shared memory is slow.
  const std::int64_t block = shared_apron() ? 1 : layout_.layout().page_shape().y;
  defines.emplace_back("BLOCK", fmt::to_string(block));
  defines.emplace_back("FOR_BLOCK(F)", repeated(block));
  defines.emplace_back("FOR_ROWS(F)", repeated(block + 2));
  const std::int64_t slices = layout_.layout().page_shape().z;
  const bool halved = shared_apron() && slices % 2 == 0;
  defines.emplace_back("DEPTH", fmt::to_string(halved ? slices / 2 : slices));
  if (shared_apron()) defines.emplace_back("SHARED_APRON", "");
  if (defines == update_defines_) return {};
  auto update = gpu::Program::compute(*device_, "solver/compute/update.comp", defines);
  if (!update) return pass_on(update);
  gpu::Defines measured = defines;
  measured.emplace_back("MEASURE_ONLY", "");
  auto measure = gpu::Program::compute(*device_, "solver/compute/update.comp", measured);
  if (!measure) return pass_on(measure);
  update_defines_ = std::move(defines);
  update_ = std::move(*update);
  measure_ = std::move(*measure);
  return {};
}

void ComputeExecutor::set_layout(const gpu::Program& program) const {
  layout_.set_uniforms(program);
  program.set("quiet_reach", glm::ivec3(band_reach()));
}

// Tells an update kernel what stays the same for a run of steps.
void ComputeExecutor::prepare_update(const gpu::Program& program) {
  program.use();
  set_layout(program);
  set_step_uniforms(program, model_.constants<float>());
  drive_textures_.set_uniforms(program, 1);
  program.set("phi_now", 0);
}

void ComputeExecutor::order_update(const gpu::Program& program, int now) {
  program.use();
  memory_.field().phi(now).bind(0);
  memory_.field().phi(1 - now).bind_image(0, true);
}

// Tells the maintenance what stays the same for a run of steps.
void ComputeExecutor::prepare_maintenance(bool count_steps) {
  maintain_.use();
  set_layout(maintain_);
  maintain_.set("band", static_cast<float>(band()));
  maintain_.set("quiet_change", static_cast<float>(kQuietChange));
  maintain_.set("constant_steps_before_release", static_cast<unsigned>(kConstantStepsBeforeRelease));
  maintain_.set("count_step", count_steps ? 1 : 0);
  memory_.field().phi(0).bind_image(2, true);
  memory_.field().phi(1).bind_image(3, true);
}

void ComputeExecutor::order_maintenance() {
  maintain_.use();
  gpu::dispatch(memory_.control(), 0);
  gpu::finish_writes();
}

// A step that takes long is submitted in pieces, so that no driver thinks it has hung. A step of its own
// (`in_pieces`) has as many pages as were counted when the last one ended.
void ComputeExecutor::dispatch_update(bool in_pieces) {
  const auto wanted = static_cast<std::int64_t>(std::ceil(seconds_per_step_ / kSecondsPerRun));
  if (!in_pieces || wanted <= 1) {
    gpu::dispatch(memory_.control(), 0);
  } else {
    constexpr std::int64_t kMostGroups = 32768;
    const std::int64_t pages = std::max<std::int64_t>(control_.active_count, 1);
    const std::int64_t piece = std::clamp<std::int64_t>((pages + wanted - 1) / wanted, 1, kMostGroups);
    for (std::int64_t first = 0; first < pages; first += piece) {
      update_.set("first_group", static_cast<unsigned>(first));
      gpu::dispatch({static_cast<int>(std::min(piece, pages - first)), 1, 1});
      gpu::Fence::insert(*device_);  // sends it on its way
    }
    update_.set("first_group", 0U);
  }
  gpu::finish_writes();
}

void ComputeExecutor::order_step(int now, int step_in_window, bool in_pieces) {
  order_update(update_, now);
  // The change over two steps is known after the second of them.
  update_.set("measure_motion", step_in_window % 2);
  const bool timed =
      options_.time_paging && paging_clock_.steps++ / kConvergenceWindow % kWindowsPerTiming == 0;
  if (timed) gpu::wait_for_gpu();
  const Stopwatch step;
  dispatch_update(in_pieces);
  if (timed) gpu::wait_for_gpu();
  const Stopwatch paging;
  order_paging(1 - now, step_in_window);
  if (!timed) return;
  gpu::wait_for_gpu();
  paging_clock_.seconds += step.seconds();
  paging_clock_.paging_seconds += paging.seconds();
}

void ComputeExecutor::order_paging(int next, int step_in_window) {
  order_maintenance();
  if (step_in_window + 1 == kConvergenceWindow) order_end_of_window(next);
}

void ComputeExecutor::order_end_of_window(int now) {
  find_quiet_pages_.use();
  set_layout(find_quiet_pages_);
  find_quiet_pages_.set("quiet_change", static_cast<float>(kQuietChange));
  find_quiet_pages_.set("skip_quiet_pages", options_.skip_quiet_pages ? 1 : 0);
  const RestRule rule = rest_rule(layout_.layout().voxels_per_page());
  find_quiet_pages_.set("samples", static_cast<unsigned>(kMotionSamples));
  find_quiet_pages_.set("window_time", static_cast<float>(rule.window_time));
  find_quiet_pages_.set("windows_to_rest", static_cast<int>(rule.windows_to_rest));
  find_quiet_pages_.set("rest_content", static_cast<float>(rule.rest_content));
  find_quiet_pages_.set("least_near_voxels", static_cast<float>(kLeastNearVoxels));
  gpu::dispatch(memory_.control(), 0);
  gpu::finish_writes();
  order_new_window(now, true, false);
}

// The next window's sums begin, and the active list is made anew.
void ComputeExecutor::order_new_window(int now, bool judge_motion, bool wake_all) {
  check_convergence_.use();
  check_convergence_.set("judge_motion", judge_motion ? 1 : 0);
  check_convergence_.set("restart", !judge_motion && !is_following() ? 1 : 0);
  check_convergence_.set("windows_to_rest",
                         static_cast<int>(rest_rule(layout_.layout().voxels_per_page()).windows_to_rest));
  gpu::dispatch(glm::ivec3(1));
  gpu::finish_writes();
  rebuild_.use();
  set_layout(rebuild_);
  rebuild_.set("wake_all", wake_all ? 1 : 0);
  memory_.field().phi(now).bind_image(0, true);
  memory_.field().phi(1 - now).bind_image(1, true);
  const std::int64_t pages = memory_.capacity() - kFirstPage;
  gpu::dispatch({static_cast<int>(std::min<std::int64_t>(pages, kGroupsPerRow)),
                 static_cast<int>((pages + kGroupsPerRow - 1) / kGroupsPerRow), 1});
  gpu::finish_writes();
}

// What moved so far no longer counts.
void ComputeExecutor::begin_window(bool wake_all) {
  memory_.bind();
  order_new_window(current_, false, wake_all);
  steps_in_window_ = 0;
  if (!is_following()) rests_ = false;
}

// Orders `count` steps and waits for them.
Result<ComputeControl> ComputeExecutor::run_steps(std::int64_t count, bool until_converged) {
  control_.stop_at_convergence = until_converged ? 1 : 0;
  control_.steps_done = 0;
  control_.voxel_updates[0] = control_.voxel_updates[1] = 0;
  memory_.write_control(control_);
  memory_.bind();
  prepare_maintenance(true);
  prepare_update(update_);
  for (std::int64_t i = 0; i < count; ++i) {
    order_step(static_cast<int>((current_ + i) % 2),
               static_cast<int>((steps_in_window_ + i) % kConvergenceWindow), count == 1);
  }
  TIDEMARK_TRY(read_control());
  TIDEMARK_TRY(device_->check("computing steps"));
  current_ = static_cast<int>((current_ + control_.steps_done) % 2);
  steps_in_window_ = static_cast<int>((steps_in_window_ + control_.steps_done) % kConvergenceWindow);
  return control_;
}

// Waits for what was ordered, and makes control_ what it left.
Status ComputeExecutor::read_control() {
  readback_.start(*device_, memory_.control(), 0);
  TIDEMARK_TRY(readback_.finish(std::as_writable_bytes(std::span(&control_, 1))));
  note_memory();
  return {};
}

void ComputeExecutor::note_memory() {
  const std::int64_t resident = memory_.capacity() - kFirstPage - control_.free_pages();
  peak_resident_ = std::max(peak_resident_, resident);
  peak_bytes_ = std::max(peak_bytes_, with_textures(PageMemory::bytes_for(layout_, memory_.capacity())));
}

Status ComputeExecutor::grow(std::int64_t more_pages) {
  const std::int64_t present = PageMemory::bytes_for(layout_, memory_.capacity());
  auto capacity = capacity_for(memory_.capacity() + more_pages, true, [&](std::int64_t pages) {
    return PageMemory::bytes_for(layout_, pages) + present;
  });
  if (!capacity) return pass_on(capacity);
  TIDEMARK_TRY(memory_.grow(*device_, *capacity, control_));
  note_memory();
  return {};
}

Status ComputeExecutor::activate_pages(NoRoom no_room) {
  needs_activation_ = true;
  TIDEMARK_TRY(read_control());
  for (;;) {
    control_.starved = 0;
    control_.converged = 0;
    memory_.write_control(control_);
    memory_.bind();
    prepare_maintenance(false);
    prepare_update(measure_);
    order_update(measure_, current_);
    gpu::dispatch(memory_.control(), 0);
    gpu::finish_writes();
    order_maintenance();
    TIDEMARK_TRY(read_control());
    TIDEMARK_TRY(device_->check("making pages resident"));
    if (control_.starved == 0) break;
    constexpr std::int64_t kFewPages = 8;  // how many are missing is not counted
    if (Status grown = grow(kFewPages); !grown) {
      return no_room == NoRoom::fails ? grown : device_->check("making pages resident");
    }
  }
  needs_activation_ = false;
  return {};
}

// Readies a run of at most so many steps; returns how many it may have. No page may wait inside of a run for
// what the processor fills.
Result<std::int64_t> ComputeExecutor::prepare_run(std::int64_t steps) {
  TIDEMARK_TRY(follow_surface());
  if (speed_->follows_surface()) {
    steps = std::min<std::int64_t>(steps, kConvergenceWindow - steps_in_window_);
  }
  if (!drive_textures_.is_filled()) return steps;
  constexpr std::int64_t kMostSteps = DriveTextures::kMostStepsOfARun;
  TIDEMARK_TRY(fill_drive(memory_.resident_pages(), kMostSteps));
  return std::min(steps, kMostSteps);
}

Result<AdvanceReport> ComputeExecutor::advance(const Advance& run) {
  constexpr std::int64_t kMostStepsPerRun = 128;
  const Stopwatch whole;
  AdvanceReport report;
  steps_of_last_run_ = 0;
  paging_clock_ = {};
  TIDEMARK_TRY(device_->make_current());
  if (needs_activation_) {
    TIDEMARK_TRY(activate_pages(NoRoom::fails));
  }
  control_.converged = 0;
  while (report.steps < run.steps && !run.progress.cancelled()) {
    auto prepared = prepare_run(std::min(run.steps - report.steps, steps_per_run_));
    if (!prepared) return pass_on(prepared);
    const std::int64_t count = *prepared;
    const Stopwatch one_run;
    const std::int32_t window = control_.window;
    auto control = run_steps(count, run.until_converged);
    if (!control) return pass_on(control);
    report.steps += control->steps_done;
    steps_of_last_run_ = report.steps;
    report.voxel_updates +=
        static_cast<std::int64_t>(control->voxel_updates[1]) << 32 | control->voxel_updates[0];
    report.surface_speed = static_cast<double>(control->surface_speed);
    report.moving_pages = control->moving_pages;
    if (control->window != window) rests_ = control->converged != 0;
    if (control->starved != 0) {
      if (auto status = activate_pages(NoRoom::fails); !status) {
        return fail(status.error().kind, "after {} steps: {}", report.steps, status.error().message);
      }
      control_.converged = 0;
    } else {
      const double seconds = std::max(one_run.seconds(), 1e-6);
      seconds_per_step_ = seconds / static_cast<double>(count);
      steps_per_run_ =
          std::clamp(static_cast<std::int64_t>(static_cast<double>(count) * kSecondsPerRun / seconds),
                     std::int64_t{1}, std::min(kMostStepsPerRun, 2 * steps_per_run_));
    }
    run.progress(static_cast<double>(report.steps) / static_cast<double>(run.steps), "steps");
    if (control->converged != 0 && run.until_converged) break;
  }
  report.converged = rests_;
  report.seconds = whole.seconds();
  if (paging_clock_.seconds > 0.0) {
    report.paging_seconds = report.seconds * paging_clock_.paging_seconds / paging_clock_.seconds;
  }
  return report;
}

Result<Field> ComputeExecutor::snapshot() const {
  TIDEMARK_TRY(device_->make_current());
  Field phi = known_;
  TIDEMARK_TRY(memory_.download(current_, phi));
  TIDEMARK_TRY(device_->check("reading phi back"));
  return known_ = std::move(phi);
}

MemoryReport ComputeExecutor::memory() const {
  MemoryReport report;
  report.resident_pages = memory_.capacity() - kFirstPage - control_.free_pages();
  report.peak_resident_pages = peak_resident_;
  report.quiet_pages = control_.quiet_pages;
  report.state_bytes = with_textures(PageMemory::bytes_for(layout_, memory_.capacity()));
  report.peak_state_bytes = peak_bytes_;
  report.source_bytes = 0;  // blocks of it count in the state
  report.page_shape = layout_.layout().page_shape();
  return report;
}

Result<std::vector<std::int64_t>> ComputeExecutor::quiet_pages() const {
  TIDEMARK_TRY(device_->make_current());
  std::vector<std::int64_t> pages = memory_.sleeping_pages();
  TIDEMARK_TRY(device_->check("reading which pages are quiet"));
  return pages;
}

Result<std::vector<std::int64_t>> ComputeExecutor::moving_pages() const {
  TIDEMARK_TRY(device_->make_current());
  return memory_.moving_pages(rest_rule(layout_.layout().voxels_per_page()));
}

bool ComputeExecutor::packed_view(PackedView& view) {
  view = {layout_, &memory_.field().phi(current_), &memory_.page_table(), static_cast<float>(band())};
  return true;
}

Status ComputeExecutor::validate() const {
  TIDEMARK_TRY(device_->make_current());
  TIDEMARK_TRY(memory_.validate());
  auto phi = snapshot();
  if (!phi) return pass_on(phi);
  return tidemark::solver::validate(*phi);
}

}  // namespace tidemark::solver
