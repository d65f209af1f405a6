#include "session/case_session.h"

#include <atomic>
#include <utility>

#include "session/case_runner.h"
#include "session/lock_step.h"
#include "study/label_segments.h"

namespace tidemark {

CaseSession::CaseSession(Engine& engine, std::shared_ptr<const LoadedStudy> study, ExecutorKind executor,
                         RestoredCase restored)
    : engine_(engine),
      study_(std::move(study)),
      outlet_(Outlet::of(this)),
      wanted_parameters_(restored.contents ? restored.contents->recipe.final_parameters()
                                           : study_->parameters) {
  state_.parameters = wanted_parameters_;
  CaseRunner::Receiver receiver;
  receiver.outlet = outlet_;
  receiver.state_arrived = [this](CaseState state) { take(std::move(state)); };
  receiver.failed = [this](const QString& message) { emit failed(message); };
  receiver.progressed = [this](double fraction, const QString& what) { emit progressed(fraction, what); };
  runner_ = std::make_shared<CaseRunner>(engine_, study_, executor, std::move(receiver), std::move(restored));
  tell([](CaseRunner& runner, const Progress&) { return runner.open(); });
}

CaseSession::~CaseSession() {
  outlet_->close();
  engine_.cancel(runner_.get());
  // Its objects die where they live.
  engine_.post(Priority::edit, nullptr, [runner = std::move(runner_)](const std::stop_token&) mutable {
    runner->close();
    runner.reset();
  });
}

std::uint64_t CaseSession::new_gesture() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

void CaseSession::tell(Command command) {
  ++edits_sent_;
  runner_->post([this_edit = edits_sent_, command = std::move(command), done = edits_done_](
                    CaseRunner& runner, const Progress& progress) -> Status {
    *done = this_edit;
    if (!runner.opened() && this_edit > 1) return {};
    return command(runner, progress);
  });
}

void CaseSession::take(CaseState state) {
  state_ = std::move(state);
  // While edits are under way, what the user sees is what was wished for.
  if (*edits_done_ == edits_sent_) wanted_parameters_ = state_.parameters;
  emit state_changed();
}

void CaseSession::play() {
  set_playing(true);
}
void CaseSession::pause() {
  set_playing(false);
}

void CaseSession::set_playing(bool playing) {
  tell([playing](CaseRunner& runner, const Progress&) -> Status {
    runner.set_playing(playing);
    return {};
  });
}

void CaseSession::step(std::int64_t steps) {
  tell([steps](CaseRunner& runner, const Progress& progress) { return runner.step(steps, progress); });
}

void CaseSession::step_back(std::int64_t steps) {
  tell([steps](CaseRunner& runner, const Progress& progress) {
    runner.set_playing(false);
    return runner.edit(runner.document().level_set().step_back(steps, progress));
  });
}

void CaseSession::restart() {
  tell([](CaseRunner& runner, const Progress&) {
    runner.set_playing(false);
    return runner.edit(runner.document().level_set().restart());
  });
}

void CaseSession::set_steps_per_picture(std::int64_t steps) {
  steps_per_picture_ = steps;
  tell([steps](CaseRunner& runner, const Progress&) -> Status {
    runner.set_steps_per_picture(steps);
    return {};
  });
}

void CaseSession::set_pause_at_convergence(bool pause) {
  pause_at_convergence_ = pause;
  tell([pause](CaseRunner& runner, const Progress&) -> Status {
    runner.set_pause_at_convergence(pause);
    return {};
  });
}

void CaseSession::set_parameters(const Parameters& parameters, std::uint64_t gesture) {
  if (parameters == wanted_parameters_) return;
  wanted_parameters_ = parameters;
  tell([parameters, gesture](CaseRunner& runner, const Progress&) {
    return runner.adjust(runner.document().level_set().set_parameters(parameters, gesture));
  });
  emit state_changed();  // every view and panel shows the wish at once
}

void CaseSession::begin(const Start& start) {
  tell([start](CaseRunner& runner, const Progress& progress) {
    runner.set_playing(false);
    return runner.edit(runner.document().level_set().begin(start, progress));
  });
}

void CaseSession::paint(const Sphere& sphere, Brush brush, std::uint64_t gesture) {
  tell([sphere, brush, gesture](CaseRunner& runner, const Progress&) {
    return runner.edit(runner.document().level_set().paint(sphere, brush, gesture));
  });
}

void CaseSession::smooth_source(double sigma_mm) {
  tell([sigma_mm](CaseRunner& runner, const Progress& progress) {
    return runner.adjust(runner.document().smooth_source(sigma_mm, progress));
  });
}

void CaseSession::change_executor(ExecutorKind kind) {
  tell([kind](CaseRunner& runner, const Progress&) { return runner.change_executor(kind); });
}

void CaseSession::undo() {
  tell([](CaseRunner& runner, const Progress&) {
    runner.set_playing(false);
    return runner.edit(runner.document().undo());
  });
}

void CaseSession::redo() {
  tell([](CaseRunner& runner, const Progress&) {
    runner.set_playing(false);
    return runner.edit(runner.document().redo());
  });
}

void CaseSession::add_label(const QString& name) {
  tell([name = name.toStdString()](CaseRunner& runner, const Progress&) -> Status {
    const auto id = runner.document().labels().add(name);
    if (!id) return tl::unexpected<Error>(id.error());
    return runner.adjust({});
  });
}

void CaseSession::set_label(const Label& label) {
  tell([label](CaseRunner& runner, const Progress&) {
    return runner.adjust(runner.document().labels().set(label));
  });
}

void CaseSession::remove_label(std::uint8_t id) {
  tell([id](CaseRunner& runner, const Progress&) {
    return runner.adjust(runner.document().labels().remove(id));
  });
}

void CaseSession::import_labels(std::shared_ptr<const Segments> segments) {
  tell([segments = std::move(segments)](CaseRunner& runner, const Progress&) {
    return runner.adjust(add_segments(runner.document().labels(), *segments));
  });
}

void CaseSession::accept_surface(std::uint8_t label, Take take) {
  tell([=](CaseRunner& runner, const Progress&) { return runner.accept_surface(label, take); });
}

void CaseSession::accept_surface_as(const QString& name, Take take) {
  tell([name = name.toStdString(), take](CaseRunner& runner, const Progress&) -> Status {
    const auto id = runner.document().labels().add(name);
    if (!id) return tl::unexpected<Error>(id.error());
    return runner.accept_surface(*id, take);
  });
}

void CaseSession::begin_from_label(std::uint8_t label) {
  tell([label](CaseRunner& runner, const Progress&) {
    runner.set_playing(false);
    return runner.edit(runner.document().begin_from_label(label));
  });
}

void CaseSession::pick(const VolumeView& view, PictureSize size, glm::dvec2 pixel,
                       std::function<void(std::optional<Hit>)> answer) {
  tell([view, size, pixel, answer = std::move(answer), outlet = outlet_](CaseRunner& runner,
                                                                         const Progress&) -> Status {
    const auto hit = runner.painter().pick(view, size, pixel, runner.document());
    if (!hit) return tl::unexpected<Error>(hit.error());
    outlet->send([answer, found = *hit] { answer(found); });
    return {};
  });
}

void CaseSession::take_snapshot(std::string view_state,
                                std::function<void(std::shared_ptr<const Snapshot>)> answer) {
  tell([view_state = std::move(view_state), answer = std::move(answer), outlet = outlet_](
           CaseRunner& runner, const Progress&) -> Status {
    Case& document = runner.document();
    document.view_state = view_state;
    if (auto status = document.history().close(); !status) return status;
    auto contents = snapshot_of(document);
    if (!contents) return pass_on(contents);
    auto snapshot =
        std::make_shared<const Snapshot>(Snapshot{std::move(*contents), document.history().position()});
    outlet->send([answer, snapshot] { answer(snapshot); });
    return {};
  });
}

void CaseSession::mark_saved(const Snapshot& snapshot) {
  tell([position = snapshot.position](CaseRunner& runner, const Progress&) -> Status {
    runner.mark_saved(position);
    return {};
  });
}

void CaseSession::play_in_lock_step(const std::vector<CaseSession*>& sessions) {
  const auto group = sessions.empty() ? nullptr : std::make_shared<LockStep>();
  for (CaseSession* session : sessions) {
    session->lock_step_ = group;
    session->tell([group](CaseRunner& runner, const Progress&) -> Status {
      runner.set_playing(false);
      group->add(runner.shared_from_this());
      return {};
    });
  }
}

void CaseSession::leave_lock_step() {
  lock_step_.reset();
  tell([](CaseRunner& runner, const Progress&) -> Status {
    runner.join({});
    return {};
  });
}

}  // namespace tidemark
