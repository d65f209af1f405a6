#include "document/executor_setup.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "imaging/filters/filters.h"
#include "solver/model.h"
#include "solver/speed/motion_limit.h"
#include "solver/speed/speed_registry.h"
#include "solver/speed/tent_speed.h"

namespace tidemark::document {
namespace {

void add(const solver::AdvanceReport& run, solver::AdvanceReport& total) {
  total.steps += run.steps;
  total.converged = run.converged;
  total.seconds += run.seconds;
  total.paging_seconds += run.paging_seconds;
  total.voxel_updates += run.voxel_updates;
  total.surface_speed = run.surface_speed;
  total.moving_pages = run.moving_pages;
}

}  // namespace

Result<std::shared_ptr<const Volume>> smoothed_source(const std::shared_ptr<const Volume>& volume,
                                                      double sigma_mm, const Progress& progress) {
  if (sigma_mm == 0.0) return volume;
  if (!std::isfinite(sigma_mm) || sigma_mm < 0.0) {
    return fail(ErrorKind::usage, "a volume cannot be smoothed by {} mm", sigma_mm);
  }
  auto source = imaging::smooth(*volume, sigma_mm, progress);
  if (!source) return pass_on(source);
  return std::make_shared<const Volume>(std::move(*source));
}

Result<ExecutorSetup> ExecutorSetup::create(std::shared_ptr<const Volume> volume, double smoothed_mm,
                                            const solver::Parameters& parameters, solver::ExecutorKind kind,
                                            const solver::ExecutorOptions& options) {
  ExecutorSetup setup;
  auto source = smoothed_source(volume, smoothed_mm);
  if (!source) return pass_on(source);
  auto executor = solver::make_executor(kind, *source, parameters, options);
  if (!executor) return pass_on(executor);
  setup.volume_ = std::move(volume);
  setup.source_ = std::move(*source);
  setup.smoothed_mm_ = smoothed_mm;
  setup.kind_ = kind;
  setup.options_ = options;
  setup.executor_ = std::move(*executor);
  return setup;
}

RecipeExecutor ExecutorSetup::description() const {
  return {std::string(executor_->name()), executor_->memory().page_shape, options_.skip_quiet_pages};
}

Status ExecutorSetup::remake(std::shared_ptr<const Volume> source, const solver::Parameters& parameters,
                             solver::ExecutorKind kind, const solver::ExecutorOptions& options,
                             const solver::Field& phi, std::shared_ptr<const solver::SpeedFunction> speed) {
  auto made = solver::make_executor(kind, source, parameters, options);
  if (!made) return pass_on(made);
  if (speed != nullptr) {
    TIDEMARK_TRY((*made)->set_speed(std::move(speed)));
  }
  if (executor_->constraints()) {
    TIDEMARK_TRY((*made)->set_constraints(executor_->constraints()));
  }
  TIDEMARK_TRY((*made)->restore(phi));
  source_ = std::move(source);
  kind_ = kind;
  options_ = options;
  executor_ = std::move(*made);
  return {};
}

Status ExecutorSetup::smooth_source(double sigma_mm, const Progress& progress) {
  auto source = smoothed_source(volume_, sigma_mm, progress);
  if (!source) return pass_on(source);
  std::shared_ptr<const solver::SpeedFunction> speed;
  if (drive_ != nullptr) {
    auto anew = make_speed(*drive_, *source, executor_->parameters(), progress);
    if (!anew) return pass_on(anew);
    speed = std::move(*anew);
  }
  return set_source(std::move(*source), sigma_mm, std::move(speed));
}

Status ExecutorSetup::set_source(std::shared_ptr<const Volume> source, double smoothed_mm,
                                 std::shared_ptr<const solver::SpeedFunction> speed) {
  const auto phi = executor_->snapshot();
  if (!phi) return pass_on(phi);
  auto fitting = solver::with_tents(std::move(speed), source, executor_->parameters());
  if (!fitting) return pass_on(fitting);
  TIDEMARK_TRY(
      remake(std::move(source), executor_->parameters(), kind_, options_, *phi, std::move(*fitting)));
  smoothed_mm_ = smoothed_mm;
  return {};
}

Status ExecutorSetup::set_conditions(double smoothed_mm, const solver::Parameters& parameters,
                                     const std::shared_ptr<const Drive>& drive) {
  if (smoothed_mm != smoothed_mm_) {
    auto source = smoothed_source(volume_, smoothed_mm);
    if (!source) return pass_on(source);
    TIDEMARK_TRY(set_source(std::move(*source), smoothed_mm, nullptr));
  }
  if (parameters != executor_->parameters()) {
    TIDEMARK_TRY(prepare(parameters));
  }
  const Drive wanted = value_of(drive);
  const Drive present = value_of(drive_);
  if (wanted == present) return {};
  const bool made = executor_->speed() != nullptr && same_speed(wanted, present);
  return set_drive(shared(wanted), made ? executor_->speed() : nullptr);
}

Status ExecutorSetup::change_executor(solver::ExecutorKind kind, const solver::ExecutorOptions& options,
                                      const solver::Field& phi) {
  return remake(source_, executor_->parameters(), kind, options, phi, executor_->speed());
}

Status ExecutorSetup::use(const RecipeExecutor& executor) {
  if (executor == description()) return resume();
  const auto phi = executor_->snapshot();
  if (!phi) return pass_on(phi);
  solver::ExecutorOptions options = options_;
  options.page_shape = executor.page_shape;
  options.skip_quiet_pages = options_.skip_quiet_pages && executor.skip_quiet_pages;
  return change_executor(solver::executor_named(executor.name).value_or(kind_), options, *phi);
}

Status ExecutorSetup::set_drive(std::shared_ptr<const Drive> drive, const Progress& progress) {
  if (drive == nullptr) return set_drive(nullptr, std::shared_ptr<const solver::SpeedFunction>());
  // Walls alone change no function, and learning one again takes long.
  const bool made = drive_ != nullptr && executor_->speed() != nullptr && same_speed(*drive_, *drive);
  if (made) return set_drive(std::move(drive), executor_->speed());
  auto speed = make_speed(*drive, source_, executor_->parameters(), progress);
  if (!speed) return pass_on(speed);
  return set_drive(std::move(drive), std::move(*speed));
}

Status ExecutorSetup::set_drive(std::shared_ptr<const Drive> drive,
                                std::shared_ptr<const solver::SpeedFunction> speed) {
  const auto former = executor_->speed();
  if (speed != former) {
    auto fitting = solver::with_tents(std::move(speed), source_, executor_->parameters());
    if (!fitting) return pass_on(fitting);
    speed = std::move(*fitting);
  }
  if (speed != former) {
    TIDEMARK_TRY(executor_->set_speed(std::move(speed)));
  }
  if (Status held = hold(drive == nullptr ? nullptr : drive->constraints, limit_); !held) {
    TIDEMARK_TRY(executor_->set_speed(former));
    return held;
  }
  drive_ = std::move(drive);
  return {};
}

bool ExecutorSetup::lacks_speed() const {
  return drive_ != nullptr && !drive_->setting.is_tent() && executor_->speed() == nullptr;
}

Status ExecutorSetup::make_missing_speed(const Progress& progress) {
  return lacks_speed() ? set_drive(drive_, progress) : Status();
}

Status ExecutorSetup::set_limit(std::shared_ptr<const solver::MotionLimit> limit) {
  TIDEMARK_TRY(hold(drive_ == nullptr ? nullptr : drive_->constraints, limit));
  limit_ = std::move(limit);
  return {};
}

// The executor gets nothing that it has: phi would count as edited.
Status ExecutorSetup::hold(std::shared_ptr<const solver::Constraints> marks,
                           std::shared_ptr<const solver::MotionLimit> limit) {
  const auto former = drive_ == nullptr ? nullptr : drive_->constraints;
  if (marks == former && limit == limit_) return {};
  return executor_->set_constraints(joined(std::move(marks), limit.get()));
}

// Other functions than tents do not depend on T and epsilon.
Status ExecutorSetup::set_parameters(const solver::Parameters& parameters) {
  if (drive_ == nullptr || !uses_tent(*drive_) || executor_->speed() == nullptr) {
    return executor_->set_parameters(parameters);
  }
  auto speed = solver::with_tents(executor_->speed(), source_, parameters);
  if (!speed) return pass_on(speed);
  TIDEMARK_TRY(executor_->set_parameters(parameters));
  return executor_->set_speed(std::move(*speed));
}

bool ExecutorSetup::has_band_of(const solver::Parameters& parameters) const {
  const double wanted = parameters.band.value_or(solver::default_band(source_->geometry));
  return static_cast<float>(wanted) == static_cast<float>(executor_->band());
}

Status ExecutorSetup::prepare(const solver::Parameters& parameters) {
  if (has_band_of(parameters)) return set_parameters(parameters);
  auto speed = solver::with_tents(executor_->speed(), source_, parameters);
  if (!speed) return pass_on(speed);
  const double band = static_cast<float>(parameters.band.value_or(solver::default_band(source_->geometry)));
  const auto outside = solver::Field::empty(source_->geometry, band, executor_->memory().page_shape);
  return remake(source_, parameters, kind_, options_, outside, std::move(*speed));
}

Result<solver::Field> ExecutorSetup::begin(const Start& start, const Progress& progress) {
  const auto former = limit_;
  // Of a mask on another grid begin() says so.
  const auto* from = std::get_if<MaskStart>(&start.from);
  const bool fits = from == nullptr || from->mask->geometry().size == source_->geometry.size;
  TIDEMARK_TRY(set_limit(fits ? start.limit() : nullptr));
  coarse_runs_.clear();
  if (!start.empty()) {
    auto begun = begin_present(start, progress);
    if (!begun) {
      TIDEMARK_TRY(set_limit(former));
    }
    return begun;
  }
  solver::Field nothing = solver::Field::empty(source_->geometry, executor_->band());
  TIDEMARK_TRY(executor_->restore(nothing));
  return nothing;
}

Result<solver::Field> ExecutorSetup::begin_present(const Start& start, const Progress& progress) {
  std::shared_ptr<const solver::SpeedFunction> speed;
  if (start.needs_speed()) {
    TIDEMARK_TRY(make_missing_speed({nullptr, progress.stop}));
    speed = executor_->speed();
    if (speed == nullptr) {
      speed = std::make_shared<const solver::TentSpeed>(source_, executor_->parameters());
    }
  }
  if (start.levels <= 1)
    return tidemark::document::begin(*executor_, {*source_, speed.get()}, start, progress);
  const CoarseInputs inputs{*source_,
                            speed,
                            drive_ == nullptr ? nullptr : drive_->constraints,
                            executor_->parameters(),
                            kind_,
                            options_,
                            executor_->band(),
                            executor_->memory().page_shape};
  auto coarse = run_coarse_levels(start, inputs, progress);
  if (!coarse) return pass_on(coarse);
  if (!*coarse) return tidemark::document::begin(*executor_, {*source_, speed.get()}, start, progress);
  TIDEMARK_TRY(executor_->restore((*coarse)->phi));
  coarse_runs_ = std::move((*coarse)->runs);
  return executor_->snapshot();
}

Status ExecutorSetup::resume() {
  const auto phi = executor_->snapshot();
  if (!phi) return pass_on(phi);
  return executor_->restore(*phi);
}

// The executor gets the function again where nothing else is new: pages that rested wake by the event, as
// they did when what is of the same values was painted or chosen once more.
Status ExecutorSetup::apply(const DriveEvent& event, const Progress& progress) {
  const auto speed = executor_->speed();
  const auto constraints = value_of(drive_).constraints;
  TIDEMARK_TRY(set_drive(event.drive, Progress{nullptr, progress.stop}));
  const bool unchanged = executor_->speed() == speed && value_of(drive_).constraints == constraints;
  return unchanged ? executor_->set_speed(speed) : Status();
}

Status ExecutorSetup::apply(const RecipeEvent& event, const Progress& progress) {
  if (const auto* paint = std::get_if<PaintEvent>(&event.what)) {
    return executor_->paint(paint->sphere, paint->brush);
  }
  if (const auto* change = std::get_if<ParametersEvent>(&event.what)) {
    return set_parameters(change->parameters);
  }
  if (const auto* smoothing = std::get_if<SmoothEvent>(&event.what))
    return smooth_source(smoothing->sigma_mm, {nullptr, progress.stop});
  if (const auto* drive = std::get_if<DriveEvent>(&event.what)) return apply(*drive, progress);
  if (const auto* other = std::get_if<ExecutorEvent>(&event.what)) return use(other->executor);
  return resume();
}

Status ExecutorSetup::play(const Recipe& recipe, std::size_t first_event, std::int64_t step,
                           std::int64_t last_step, const Progress& progress, solver::AdvanceReport* total,
                           bool until_converged) {
  const std::int64_t first_step = step;
  const auto advance_to = [&](std::int64_t target, bool to_rest) -> Status {
    if (step < target) {
      TIDEMARK_TRY(make_missing_speed({nullptr, progress.stop}));
    }
    while (step < target) {
      if (progress.cancelled()) return cancelled_error();
      solver::Advance run{target - step, to_rest, {nullptr, progress.stop}};
      run.progress.report = [&](double fraction, std::string_view what) {
        const double done =
            static_cast<double>(step - first_step) + fraction * static_cast<double>(run.steps);
        progress(done / static_cast<double>(last_step - first_step), what);
      };
      const auto report = executor_->advance(run);
      if (!report) return pass_on(report);
      step += report->steps;
      if (total != nullptr) add(*report, *total);
      if (to_rest && report->converged) break;
    }
    return {};
  };
  for (std::size_t i = first_event; i < recipe.events.size(); ++i) {
    const RecipeEvent& event = recipe.events[i];
    if (event.step > last_step) break;
    TIDEMARK_TRY(advance_to(event.step, false));
    TIDEMARK_TRY(apply(event, progress));
  }
  return advance_to(last_step, until_converged);
}

}  // namespace tidemark::document
