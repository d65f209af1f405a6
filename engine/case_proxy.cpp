#include "engine/case_proxy.h"

#include <algorithm>
#include <atomic>
#include <iterator>
#include <utility>

#include "core/without_exceptions.h"
#include "engine/case_balance.h"
#include "engine/case_passes.h"
#include "engine/case_runner.h"
#include "engine/case_sweep.h"
#include "engine/label_finisher.h"
#include "engine/lock_step.h"
#include "engine/region_meter.h"
#include "engine/surface_maps.h"
#include "engine/wanted_map.h"

namespace tidemark::engine {
namespace {

// Held by a command, it calls back once that is over, however it ended.
class LastCall {
 public:
  LastCall(std::shared_ptr<WeakReceiver> receiver, std::function<void()> call)
      : receiver_(std::move(receiver)), call_(std::move(call)) {}
  ~LastCall() {
    if (call_) receiver_->send(std::move(call_));
  }
  LastCall(const LastCall&) = delete;
  LastCall& operator=(const LastCall&) = delete;
  void forget() { call_ = nullptr; }

 private:
  std::shared_ptr<WeakReceiver> receiver_;
  std::function<void()> call_;
};

}  // namespace

CaseProxy::CaseProxy(Engine& engine, std::shared_ptr<const LoadedStudy> study, solver::ExecutorKind executor,
                     RestoredCase restored)
    : engine_(engine),
      study_(std::move(study)),
      truth_(restored.truth(*study_)),
      weak_receiver_(WeakReceiver::of(this)),
      askers_(WeakReceiver::of(this)),
      sweep_(std::make_unique<CaseSweep>(*this)),
      label_finisher_(std::make_unique<LabelFinisher>(*this)),
      region_meter_(std::make_unique<RegionMeter>(*this)),
      wanted_parameters_(restored.contents ? restored.contents->recipe.final_parameters()
                                           : study_->parameters) {
  state_.parameters = wanted_parameters_;
  saved_ = attachments();
  balance_ = std::make_unique<CaseBalance>(*this);
  passes_ = std::make_unique<CasePasses>(*this);
  CaseRunner::Receiver receiver;
  receiver.weak_receiver = weak_receiver_;
  receiver.state_arrived = [this](CaseState state) { take(std::move(state)); };
  receiver.failed = [this](const QString& message) { emit failed(message); };
  receiver.progressed = [this](double fraction, const QString& what) { emit progressed(fraction, what); };
  receiver.given_up = [this] { emit given_up(); };
  runner_ = std::make_shared<CaseRunner>(engine_, study_, executor, std::move(receiver), std::move(restored));
  post([](CaseRunner& runner, const Progress&) { return runner.open(); });
  connect(&display_, &Display::changed, this, &CaseProxy::use_images_of_display);
  connect(&display_, &Display::changed, this, &CaseProxy::show_distances);
  connect(&display_, &Display::changed, this, &CaseProxy::follow_modified);
  const auto show = [this](SurfaceMap which) {
    return [this, which](const WantedMap::Map& map) {
      post([which, map](CaseRunner& runner, const Progress&) {
        runner.painter().set_surface_map(map ? which : SurfaceMap::none, map);
        return Status();
      });
    };
  };
  truth_error_ = std::make_unique<WantedMap>(show(SurfaceMap::truth_error));
  spread_ = std::make_unique<WantedMap>(show(SurfaceMap::spread));
  use_truth();
}

CaseProxy::~CaseProxy() {
  truth_error_.reset();
  spread_.reset();
  balance_.reset();
  passes_.reset();
  weak_receiver_->close();
  askers_->close();
  engine_.cancel(runner_.get());
  // Its objects die where they live.
  engine_.post(Priority::edit, nullptr, [runner = std::move(runner_)](const std::stop_token&) mutable {
    runner->close();
    runner.reset();
  });
}

void CaseProxy::compare_with(std::shared_ptr<const BitMask> truth) {
  truth_ = std::move(truth);
  state_.dice.reset();
  use_truth();
  state_.modified = modified();
  post([truth = truth_](CaseRunner& runner, const Progress&) {
    runner.compare_with(truth);
    return Status();
  });
  emit state_changed();
}

void CaseProxy::use_truth() {
  truth_error_->set_make(truth_ ? [truth = truth_] { return truth_error_map(*truth); } : WantedMap::Make());
}

SurfaceMap CaseProxy::wanted_surface_map() const {
  if (display_.spread()) return SurfaceMap::spread;
  return truth_ && display_.settings().truth_error ? SurfaceMap::truth_error : SurfaceMap::none;
}

// One of them at a time. What is shown no more goes before the other one comes.
void CaseProxy::show_distances() {
  const auto& runs = display_.spread();
  if (runs && runs != spread_runs_) {
    spread_runs_ = runs;
    spread_->set_make([runs, grid = volume().geometry] { return spread_map(*runs, grid); });
  }
  if (runs) truth_error_->set_wanted(false);
  spread_->set_wanted(runs != nullptr);
  truth_error_->set_wanted(!runs && display_.settings().truth_error);
}

std::uint64_t CaseProxy::new_gesture() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

void CaseProxy::post(Command command) {
  const auto carry_out = [command = std::move(command)](CaseRunner& runner,
                                                        const Progress& progress) -> Status {
    if (const Error* obstacle = runner.obstacle()) return tl::unexpected<Error>(*obstacle);
    return command(runner, progress);
  };
  last_command_ = runner_->post(carry_out);
}

void CaseProxy::take(CaseState state) {
  state_ = std::move(state);
  case_modified_ = state_.modified;
  state_.modified = modified();
  // While commands are under way, the user sees the wanted values.
  if (state_.commands == last_command_) {
    wanted_parameters_ = state_.parameters;
    wanted_drive_ = state_.drive;
    show_images_of_drive();
  }
  comparison_.follow(state_);
  emit state_changed();
}

Attachments CaseProxy::attachments() const {
  return attachments_of(display_.settings());
}

Attachments CaseProxy::attachments_of(const DisplaySettings& settings) const {
  Attachments found;
  for (const ShownImage& shown : settings.images) found.images.push_back(shown.image);
  if (has_another_truth()) found.truth = truth_;
  std::ranges::copy_if(settings.measurements, std::back_inserter(found.measurements), &Measurement::complete);
  return found;
}

// An image is read again, so that another one may be the same; an accepted registration moves it.
bool CaseProxy::has_saved_attachments() const {
  const auto is_same = [](const auto& a, const auto& b) {
    return a->name == b->name && a->checksum == b->checksum && a->to_case == b->to_case;
  };
  const Attachments now = attachments();
  return now.truth == saved_.truth && now.measurements == saved_.measurements &&
         std::ranges::is_permutation(now.images, saved_.images, is_same);
}

bool CaseProxy::modified() const {
  return case_modified_ || !has_saved_attachments();
}

void CaseProxy::follow_modified() {
  const bool now = modified();
  if (std::exchange(state_.modified, now) != now) emit state_changed();
}

void CaseProxy::play() {
  set_playing(true);
}
void CaseProxy::pause() {
  set_playing(false);
}

void CaseProxy::set_playing(bool playing) {
  post([playing](CaseRunner& runner, const Progress&) -> Status {
    runner.set_playing(playing);
    return {};
  });
}

void CaseProxy::play_for(std::int64_t steps, bool until_rest, std::function<void(bool reached)> ended) {
  leave_lock_step();
  const auto unplayed = std::make_shared<LastCall>(weak_receiver_, [ended] { ended(false); });
  post(
      [steps, until_rest, ended = std::move(ended), unplayed](CaseRunner& runner, const Progress&) -> Status {
        unplayed->forget();
        runner.play({steps, until_rest, ended});
        return {};
      });
}

void CaseProxy::measure(std::function<void()> answer) {
  post([](CaseRunner& runner, const Progress&) { return runner.measure_now(); });
  after_commands(std::move(answer));
}

// The state of a command is sent before the command goes.
void CaseProxy::after_commands(std::function<void()> answer) {
  post([last = std::make_shared<const LastCall>(askers_, std::move(answer))](
           CaseRunner&, const Progress&) -> Status { return {}; });
}

void CaseProxy::step(std::int64_t steps) {
  post([steps](CaseRunner& runner, const Progress& progress) { return runner.step(steps, progress); });
}

void CaseProxy::step_back(std::int64_t steps) {
  post([steps](CaseRunner& runner, const Progress& progress) {
    runner.set_playing(false);
    return runner.report_edit(runner.document().level_set().step_back(steps, progress));
  });
}

void CaseProxy::restart() {
  post([](CaseRunner& runner, const Progress&) {
    runner.set_playing(false);
    return runner.report_edit(runner.document().level_set().restart());
  });
}

void CaseProxy::set_steps_per_picture(std::int64_t steps) {
  steps_per_picture_ = steps;
  post([steps](CaseRunner& runner, const Progress&) -> Status {
    runner.set_steps_per_picture(steps);
    return {};
  });
}

void CaseProxy::set_pace(double steps_per_second) {
  post([steps_per_second](CaseRunner& runner, const Progress&) -> Status {
    runner.set_pace(steps_per_second);
    return {};
  });
}

void CaseProxy::set_pause_at_convergence(bool pause) {
  pause_at_convergence_ = pause;
  post([pause](CaseRunner& runner, const Progress&) -> Status {
    runner.set_pause_at_convergence(pause);
    return {};
  });
}

void CaseProxy::set_leak_rule(const std::optional<document::LeakRule>& rule) {
  leak_rule_ = rule;
  post([rule](CaseRunner& runner, const Progress&) -> Status {
    runner.set_leak_rule(rule);
    return {};
  });
}

void CaseProxy::change_parameters(const ParameterChange& change, std::uint64_t gesture) {
  solver::Parameters wanted = wanted_parameters_;
  change(wanted);
  if (wanted == wanted_parameters_) return;
  wanted_parameters_ = wanted;
  post([change, gesture](CaseRunner& runner, const Progress&) {
    document::LevelSet& level_set = runner.document().level_set();
    solver::Parameters parameters = level_set.parameters();
    change(parameters);
    if (parameters.band == level_set.parameters().band)
      return runner.report_change(level_set.set_parameters(parameters, gesture));
    runner.set_playing(false);
    return runner.report_edit(level_set.set_parameters(parameters, gesture));  // it begins again
  });
  emit state_changed();  // every view and panel shows the wish at once
}

void CaseProxy::set_parameters(const solver::Parameters& parameters, std::uint64_t gesture) {
  change_parameters([parameters](solver::Parameters& wanted) { wanted = parameters; }, gesture);
}

CaseProxy::ChangedDrive CaseProxy::want(const DriveChange& change) {
  const document::Drive before = wanted_drive_;
  document::Drive after = before;
  change(after);
  after.images.clear();
  if (document::uses_images(after.setting)) after.images = used_images(display_.settings().images);
  if (after == before) return {};
  wanted_drive_ = after;
  return [change, before, after](const document::Drive& present) {
    if (present == before) return after;
    document::Drive changed = present;
    change(changed);
    // Where the change left the images alone, those that the case has stay.
    const bool keeps = after.images == before.images && document::uses_images(present.setting);
    changed.images = keeps ? present.images : after.images;
    if (!document::uses_images(changed.setting)) changed.images.clear();
    return changed;
  };
}

void CaseProxy::change_drive(const DriveChange& change, std::uint64_t gesture) {
  const ChangedDrive changed = want(change);
  if (!changed) return;
  post([changed, gesture](CaseRunner& runner, const Progress&) {
    document::LevelSet& level_set = runner.document().level_set();
    return runner.report_edit(level_set.set_drive(changed(level_set.drive()), gesture));
  });
  emit state_changed();
}

void CaseProxy::set_drive(const document::Drive& drive, std::uint64_t gesture) {
  change_drive([drive](document::Drive& wanted) { wanted = drive; }, gesture);
}

void CaseProxy::take_stroke(const DriveChange& change, const std::vector<std::int64_t>& voxels,
                            std::int64_t steps) {
  const ChangedDrive changed = want(change);
  if (!changed) return;
  post([changed, voxels, steps, gesture = new_gesture()](CaseRunner& runner, const Progress& progress) {
    const document::Drive drive = changed(runner.document().level_set().drive());
    return runner.take_stroke(drive, voxels, steps, gesture, progress);
  });
  emit state_changed();
}

// An image was added, moved, taken away, or is to be used or not.
void CaseProxy::use_images_of_display() {
  if (!document::uses_images(wanted_drive_.setting)) return;
  // Every change gets those of the display.
  if (wanted_drive_.images != used_images(display_.settings().images))
    change_drive([](document::Drive&) {}, new_gesture());
}

// Undo, or a session, has brought others.
void CaseProxy::show_images_of_drive() {
  if (!document::uses_images(wanted_drive_.setting)) return;
  if (wanted_drive_.images == used_images(display_.settings().images)) return;
  display_.change([&](DisplaySettings& settings) { use_images(settings.images, wanted_drive_.images); });
}

void CaseProxy::begin(const document::Start& start) {
  post([start](CaseRunner& runner, const Progress& progress) {
    runner.set_playing(false);
    return runner.report_edit(runner.document().level_set().begin(start, progress));
  });
}

void CaseProxy::paint(const solver::Sphere& sphere, solver::Brush brush, std::uint64_t gesture) {
  post([sphere, brush, gesture](CaseRunner& runner, const Progress&) -> Status {
    document::LevelSet& level_set = runner.document().level_set();
    if (!level_set.begun()) {
      // Beside the volume there is nothing that a surface could begin with.
      document::Start only;
      only.seeds.push_back(sphere);
      TIDEMARK_TRY(document::check_spheres(only, runner.document().volume()->geometry));
    }
    return runner.report_edit(level_set.paint(sphere, brush, gesture));
  });
}

void CaseProxy::smooth_source(double sigma_mm) {
  post([sigma_mm](CaseRunner& runner, const Progress&) { return runner.smooth_source(sigma_mm); });
}

void CaseProxy::change_executor(solver::ExecutorKind kind) {
  post([kind](CaseRunner& runner, const Progress&) { return runner.change_executor(kind); });
}

void CaseProxy::undo() {
  post([](CaseRunner& runner, const Progress&) { return runner.undo(); });
}

void CaseProxy::redo() {
  post([](CaseRunner& runner, const Progress&) {
    runner.set_playing(false);
    return runner.report_edit(runner.document().redo());
  });
}

void CaseProxy::go_to(std::uint64_t state) {
  post([state](CaseRunner& runner, const Progress&) { return runner.go_to(state); });
}

// Every command ends with the state.
void CaseProxy::translate_state() {
  post([](CaseRunner&, const Progress&) -> Status { return {}; });
}

void CaseProxy::pick(const renderer::VolumeView& view, renderer::PictureSize size,
                     std::shared_ptr<const document::Labels> labels, glm::dvec2 pixel,
                     std::function<void(std::optional<renderer::Hit>)> answer) {
  post([view, size, labels = std::move(labels), pixel, answer = std::move(answer), askers = askers_](
           CaseRunner& runner, const Progress&) -> Status {
    const auto hit = runner.painter().pick(view, size, labels.get(), pixel, runner.document());
    if (!hit) return pass_on(hit);
    askers->send([answer, found = *hit] { answer(found); });
    return {};
  });
}

void CaseProxy::record_step(std::int64_t page, std::function<void(const Result<RecordedStep>&)> answer) {
  const auto unanswered = std::make_shared<LastCall>(weak_receiver_, [answer] { answer(cancelled_error()); });
  post([page, answer = std::move(answer), unanswered, weak_receiver = weak_receiver_](
           CaseRunner& runner, const Progress&) -> Status {
    document::LevelSet& level_set = runner.document().level_set();
    auto recorded = without_exceptions([&]() -> Result<RecordedStep> {
      auto record = level_set.executor().record_step(page);
      if (!record) return pass_on(record);
      return RecordedStep{std::move(*record), level_set.step()};
    });
    weak_receiver->send([answer, recorded = std::move(recorded)] { answer(recorded); });
    unanswered->forget();
    return {};
  });
}

void CaseProxy::take_snapshot(std::string view_state,
                              std::function<void(std::shared_ptr<const Snapshot>)> answer,
                              std::function<void()> gave_up, OpenChange open) {
  using Taken = Result<std::shared_ptr<const Snapshot>>;
  post([view_state = std::move(view_state), attachments = attachments(), open, answer = std::move(answer),
        unanswered = std::make_shared<LastCall>(askers_, std::move(gave_up)),
        askers = askers_](CaseRunner& runner, const Progress&) -> Status {
    const Taken taken = without_exceptions([&]() -> Taken {
      document::Case& document = runner.document();
      document.view_state = view_state;
      if (open == OpenChange::ends) {
        TIDEMARK_TRY(document.history().close());
      }
      auto contents = document::snapshot_of(document);
      if (!contents) return pass_on(contents);
      contents->images = attachments.images;
      contents->truth = attachments.truth;
      return std::make_shared<const Snapshot>(
          Snapshot{std::move(*contents), attachments, document.history().position()});
    });
    if (!taken) return pass_on(taken);
    askers->send([answer, snapshot = *taken] { answer(snapshot); });
    unanswered->forget();
    return {};
  });
}

void CaseProxy::mark_saved(const Snapshot& snapshot) {
  saved_ = snapshot.attachments;
  mark_surface_saved(snapshot.position);
}

void CaseProxy::mark_surface_saved(std::uint64_t position) {
  post([position](CaseRunner& runner, const Progress&) -> Status {
    runner.mark_saved(position);
    return {};
  });
}

void CaseProxy::prepare_sweep(std::function<void(const Result<document::SweepStart>&)> answer) {
  const auto unanswered = std::make_shared<LastCall>(weak_receiver_, [answer] { answer(cancelled_error()); });
  post([answer = std::move(answer), unanswered, weak_receiver = weak_receiver_](CaseRunner& runner,
                                                                                const Progress&) -> Status {
    auto start = without_exceptions([&] { return runner.document().level_set().sweep_start(); });
    weak_receiver->send([answer, start = std::move(start)] { answer(start); });
    unanswered->forget();
    return {};
  });
}

void CaseProxy::take_run(std::shared_ptr<const document::SweepStart> start, const document::SweepRun& run) {
  document::SweepRun taken = run;
  taken.inside = {};
  post([start = std::move(start), taken](CaseRunner& runner, const Progress& progress) {
    return runner.take_run(*start, taken, progress);
  });
}

void CaseProxy::play_in_lock_step(const std::vector<CaseProxy*>& proxies) {
  const auto group = proxies.empty() ? nullptr : std::make_shared<LockStep>();
  for (CaseProxy* proxy : proxies) {
    proxy->lock_step_ = group;
    proxy->post([group](CaseRunner& runner, const Progress&) -> Status {
      runner.set_playing(false);
      group->add(runner.shared_from_this());
      return {};
    });
  }
}

void CaseProxy::leave_lock_step() {
  lock_step_.reset();
  post([](CaseRunner& runner, const Progress&) -> Status {
    runner.join({});
    return {};
  });
}

}  // namespace tidemark::engine
