#include "ui/main/case_files.h"

#include <QFileInfo>
#include <QStatusBar>

#include "core/without_exceptions.h"
#include "engine/background_job.h"
#include "engine/message_text.h"
#include "imaging/audit/event.h"
#include "ui/main/main_window.h"
#include "ui/results/file_name.h"
#include "ui/widgets/path_text.h"
#include "ui/widgets/save_file.h"

namespace tidemark::ui {
namespace {

// The work, which writes a file of a study.
CaseFiles::Work audited(const std::shared_ptr<const engine::LoadedStudy>& study, const QString& file,
                        CaseFiles::Work work) {
  return [study, path = path_of(file), work = std::move(work)] {
    return imaging::exported(without_exceptions(work), study->audited, {path});
  };
}

// For messages: the same case to a file of the same kind.
QString about_writing(const CaseWindow& window, const QString& file) {
  return QStringLiteral("%1 of %2").arg(QFileInfo(file).suffix()).arg(reinterpret_cast<quintptr>(&window));
}

}  // namespace

CaseFiles::CaseFiles(MainWindow& window) : QObject(&window), window_(window) {}

CaseFiles::~CaseFiles() {
  for (const auto& job : jobs_) job->abandon();
}

QString CaseFiles::ask_for_file(CaseWindow& window, const QString& title, const QString& suffixes) {
  const QPointer alive(&window);
  const QString file = ask_where_to_save(window_, title, file_name_of(window.proxy().study()), suffixes);
  if (!alive || file.isEmpty()) return {};
  if (!is_of_study(window.proxy().study(), path_of(file))) return file;
  window_.tell(tr("%1 is a file of the study, which is never written to: choose another name.").arg(file),
               about_writing(window, file));
  return {};
}

void CaseFiles::write(CaseWindow& window, const QString& file, Work work, Ended ended) {
  run({about_writing(window, file), file, audited(window.proxy().shared_study(), file, std::move(work)),
       std::move(ended)});
}

void CaseFiles::write_contents(CaseWindow& window, const QString& file,
                               std::function<Status(const document::SessionContents&)> work) {
  await(window);
  const auto write = [this, about = about_writing(window, file), file, from = &window,
                      study = window.proxy().shared_study(), work = std::move(work)](const auto& snapshot) {
    run({about, file, audited(study, file, [snapshot, work] { return work(snapshot->contents); }), {}});
    no_longer_await(from);
  };
  window.proxy().take_snapshot(window.view_state(), write, [this, from = &window] { no_longer_await(from); });
}

void CaseFiles::await(const CaseWindow& window) {
  if (++awaited_[&window] == 1)
    connect(&window, &QObject::destroyed, this, [this, gone = &window] { awaited_.remove(gone); });
}

void CaseFiles::no_longer_await(const CaseWindow* window) {
  if (--awaited_[window] > 0) return;
  awaited_.remove(window);
  emit waits_no_more(window);
}

void CaseFiles::run(Write write) {
  Write* before = nullptr;
  for (Write& other : writes_) {
    if (other.next == nullptr && is_same_place(other.file, write.file)) before = &other;
  }
  writes_.push_back(std::move(write));
  if (before) {
    before->next = &writes_.back();
  } else {
    start(writes_.back());
  }
}

void CaseFiles::start(Write& write) {
  jobs_.push_back(engine::BackgroundJob::start(
      this,
      [this, &write, work = std::move(write.work)](engine::BackgroundJob& job) {
        job.deliver([this, &write, status = work()] { end(write, status); });
      },
      [this, &write](const Error& error) { end(write, tl::unexpected<Error>(error)); }));
}

void CaseFiles::end(const Write& write, const Status& status) {
  const Write done = write;
  writes_.remove_if([&](const Write& one) { return &one == &write; });
  if (done.next) start(*done.next);
  if (status) {
    window_.dismiss_about(done.about);
    window_.statusBar()->showMessage(tr("Wrote %1").arg(done.file), 8000);
  } else {
    window_.tell(engine::message_text(status.error()), done.about);
  }
  if (done.ended) done.ended(status.has_value());
  if (status) emit written(done.file);
  emit ended();
}

}  // namespace tidemark::ui
