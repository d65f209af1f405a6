#include "engine/case_autosave.h"

#include <QStandardPaths>
#include <mutex>
#include <optional>

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

  Status write(const document::SessionContents& contents) {
    const std::lock_guard lock(mutex);
    if (closed) return {};
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

  void close() {
    const std::lock_guard lock(mutex);
    closed = true;
    if (files) files->finish();
    files.reset();
  }
};

CaseAutosave::CaseAutosave(CaseProxy& proxy, std::filesystem::path folder,
                           std::function<std::string()> view_state)
    : proxy_(proxy), view_state_(std::move(view_state)), copies_(std::make_shared<Copies>()) {
  copies_->folder = std::move(folder);
  connect(&proxy_, &CaseProxy::state_changed, this, &CaseAutosave::follow);
  connect(&timer_, &QTimer::timeout, this, &CaseAutosave::save_now);
  timer_.start(kSeconds * 1000);
}

CaseAutosave::~CaseAutosave() {
  if (job_) job_->abandon();
  // Waiting for a copy that is being written could block the user interface.
  BackgroundJob::start(this, [copies = copies_](BackgroundJob&) { copies->close(); })->abandon();
}

void CaseAutosave::follow() {
  if (was_modified_ && !proxy_.state().modified) {
    BackgroundJob::start(this, [copies = copies_](BackgroundJob&) { copies->drop(); })->abandon();
  }
  // By an image or a truth, which are no edits of the history.
  if (!was_modified_ && proxy_.state().modified) saved_step_ = -1;
  was_modified_ = proxy_.state().modified;
  if (soon_ || proxy_.state().edits >= saved_edits_ + kEdits) save_now();
}

void CaseAutosave::save_now() {
  const CaseState& state = proxy_.state();
  const bool is_new = soon_ || state.edits != saved_edits_ || state.step != saved_step_;
  if (!state.modified || !is_new || writing_ || failed_) return;
  writing_ = true;
  soon_ = false;
  saved_edits_ = state.edits;
  saved_step_ = state.step;
  const auto write = [self = QPointer(this)](const auto& snapshot) {
    if (!self) return;
    self->job_ = BackgroundJob::start(
        self,
        [self, copies = self->copies_, snapshot](BackgroundJob& job) {
          const Status status = copies->write(snapshot->contents);
          job.deliver([self, status] { self->copied(status); });
        },
        [self](const Error& error) { self->copied(tl::unexpected<Error>(error)); });
  };
  // The case has said why. It may be better off with the next tick.
  const auto gave_up = [self = QPointer(this)] {
    if (!self) return;
    self->writing_ = false;
    self->saved_step_ = -1;
  };
  proxy_.take_snapshot(view_state_(), write, gave_up);
}

void CaseAutosave::copied(const Status& status) {
  writing_ = false;
  if (status) return emit saved();
  failed_ = true;
  emit failed(message_text(status.error()));
}

std::filesystem::path recovery_folder() {
  return std::filesystem::path(
             QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation).toStdU16String()) /
         "recovery";
}

}  // namespace tidemark::engine
