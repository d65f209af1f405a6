#include "engine/case_autosave.h"

#include <QStandardPaths>
#include <atomic>
#include <mutex>
#include <optional>
#include <utility>

#include "document/recovery_folder.h"
#include "engine/background_job.h"
#include "engine/message_text.h"

namespace tidemark::engine {

// Shared with the thread that writes; made when there is something to write.
struct CaseAutosave::Copies {
  std::mutex mutex;
  std::filesystem::path folder;
  std::string id = document::new_copy_id();
  std::optional<document::Autosave> files;
  bool closed = false;
  std::atomic<std::uint64_t> drops = 0;  // asked for

  // `seen`: drops when the copy was asked for. One that is out of date by then is not written.
  Status write(const document::SessionContents& contents, std::uint64_t seen) {
    const std::lock_guard lock(mutex);
    if (closed || drops != seen) return {};
    if (!files) {
      auto made = document::Autosave::create(folder, id);
      if (!made) return pass_on(made);
      files.emplace(std::move(*made));
    }
    return files->write(contents);
  }

  // The copied state is in a file now.
  void drop() {
    const std::lock_guard lock(mutex);
    if (files) files->finish();
    files.reset();
  }

  void close(bool keeps) {
    const std::lock_guard lock(mutex);
    closed = true;
    if (files && !keeps) files->finish();
    files.reset();
  }
};

CaseAutosave::CaseAutosave(CaseProxy& proxy, std::filesystem::path folder,
                           std::function<std::string()> view_state, std::chrono::milliseconds interval)
    : proxy_(proxy), view_state_(std::move(view_state)), copies_(std::make_shared<Copies>()) {
  copies_->folder = std::move(folder);
  connect(&proxy_, &CaseProxy::state_changed, this, &CaseAutosave::follow);
  connect(&timer_, &QTimer::timeout, this, &CaseAutosave::save_now);
  // The last copy is all that is left of the work: it is offered at the next start.
  connect(&proxy_, &CaseProxy::given_up, this, [this] { keeps_ = true; });
  timer_.start(interval);
}

CaseAutosave::~CaseAutosave() {
  if (job_) job_->abandon();
  // Waiting for a copy that is being written could block the user interface.
  BackgroundJob::start(this, [copies = copies_, keeps = keeps_](BackgroundJob&) {
    copies->close(keeps);
  })->abandon();
}

CaseAutosave::Copied CaseAutosave::present() const {
  const CaseState& state = proxy_.state();
  return {state.edits, state.step, state.steered, state.parameters, state.drive, proxy_.attachments()};
}

void CaseAutosave::follow() {
  if (was_modified_ && !proxy_.state().modified) {
    last_ = present();
    ++copies_->drops;
    BackgroundJob::start(this, [copies = copies_](BackgroundJob&) { copies->drop(); })->abandon();
  }
  was_modified_ = proxy_.state().modified;
  if (soon_ || proxy_.state().edits >= last_.edits + kEdits) save_now();
}

void CaseAutosave::save_soon() {
  soon_ = true;
  if (proxy_.state().commands > 0) save_now();
}

void CaseAutosave::save_now() {
  if (!proxy_.state().modified || writing_ || keeps_) return;
  Copied now = present();
  if (!soon_ && now == last_) return;
  writing_ = true;
  soon_ = false;
  last_ = std::move(now);
  const auto write = [self = QPointer(this), seen = copies_->drops.load()](const auto& snapshot) {
    if (!self) return;
    self->job_ = BackgroundJob::start(
        self,
        [self, copies = self->copies_, snapshot, seen](BackgroundJob& job) {
          const Status status = copies->write(snapshot->contents, seen);
          job.deliver([self, status] { self->copied(status); });
        },
        [self](const Error& error) { self->copied(tl::unexpected<Error>(error)); });
  };
  // The case has said why. It may be better off with the next tick.
  const auto gave_up = [self = QPointer(this)] {
    if (!self) return;
    self->writing_ = false;
    self->last_.step = -1;
  };
  proxy_.take_snapshot(view_state_(), write, gave_up, CaseProxy::OpenChange::goes_on);
}

void CaseAutosave::copied(const Status& status) {
  writing_ = false;
  const bool fails_again = std::exchange(fails_, !status.has_value());
  if (status) return emit saved();
  last_.step = -1;
  if (!fails_again) emit failed(message_text(status.error()));
}

std::filesystem::path recovery_folder() {
  return std::filesystem::path(
             QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation).toStdU16String()) /
         "recovery";
}

}  // namespace tidemark::engine
