#include "engine/case_proxy.h"

#include <atomic>
#include <utility>

#include "core/without_exceptions.h"
#include "engine/case_balance.h"
#include "engine/case_passes.h"
#include "engine/case_runner.h"
#include "engine/case_sweep.h"
#include "engine/label_finisher.h"
#include "engine/last_call.h"
#include "engine/region_meter.h"
#include "engine/surface_maps.h"
#include "engine/wanted_map.h"

namespace tidemark::engine {

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

// The state of a command is sent before the command goes.
void CaseProxy::after_commands(std::function<void()> answer) {
  post([last = std::make_shared<const LastCall>(askers_, std::move(answer))](
           CaseRunner&, const Progress&) -> Status { return {}; });
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

}  // namespace tidemark::engine
