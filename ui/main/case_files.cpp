#include "ui/main/case_files.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <QRegularExpression>
#include <QStatusBar>

#include "core/without_exceptions.h"
#include "engine/background_job.h"
#include "engine/message_text.h"
#include "imaging/audit/event.h"
#include "ui/main/main_window.h"
#include "ui/results/file_name.h"
#include "ui/settings.h"
#include "ui/widgets/path_text.h"

namespace tidemark::ui {
namespace {

// A name that has none of the endings of a filter ("NIfTI (*.nii.gz *.nii)") gets the first: the suffix says
// which format is written, and a name may have dots of its own.
QString with_suffix(const QString& file, const QString& chosen, const QString& all) {
  static const QRegularExpression kEnding(QStringLiteral("\\*(\\.[\\w.]+)"));
  for (auto endings = kEnding.globalMatch(all); endings.hasNext();) {
    if (file.endsWith(endings.next().captured(1), Qt::CaseInsensitive)) return file;
  }
  return file + kEnding.match(chosen).captured(1);
}

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
  QFileDialog dialog(&window_, title, settings::save_folder().get(), suffixes);
  dialog.setAcceptMode(QFileDialog::AcceptSave);
  dialog.selectFile(file_name_of(window.proxy().study()));
  if (dialog.exec() != QDialog::Accepted || dialog.selectedFiles().isEmpty()) return {};
  const QString named = dialog.selectedFiles().first();
  const QString file = with_suffix(named, dialog.selectedNameFilter(), suffixes);
  // The dialog has asked about the name as it was typed.
  if (file != named && QFileInfo::exists(file) &&
      QMessageBox::question(&window_, title, tr("%1 exists. Replace it?").arg(file),
                            QMessageBox::Yes | QMessageBox::No, QMessageBox::No) != QMessageBox::Yes) {
    return {};
  }
  if (!alive) return {};
  settings::save_folder().set(QFileInfo(file).absolutePath());
  return file;
}

void CaseFiles::write(CaseWindow& window, const QString& file, Work work, std::function<void()> done) {
  run(about_writing(window, file), file, audited(window.proxy().shared_study(), file, std::move(work)),
      std::move(done));
}

void CaseFiles::write_contents(CaseWindow& window, const QString& file,
                               std::function<Status(const document::SessionContents&)> work) {
  window.proxy().take_snapshot(window.view_state(), [this, about = about_writing(window, file), file,
                                                     study = window.proxy().shared_study(),
                                                     work = std::move(work)](const auto& snapshot) {
    run(about, file, audited(study, file, [snapshot, work] { return work(snapshot->contents); }), {});
  });
}

void CaseFiles::run(const QString& about, const QString& file, Work work, std::function<void()> done) {
  jobs_.push_back(
      engine::BackgroundJob::start(this, [this, about, file, work = std::move(work), done](auto& job) {
        const Status status = work();
        job.deliver([this, about, file, status, done] {
          if (!status) return window_.tell(engine::message_text(status.error()), about);
          window_.dismiss_about(about);
          window_.statusBar()->showMessage(tr("Wrote %1").arg(file), 8000);
          if (done) done();
          emit written(file);
        });
      }));
}

}  // namespace tidemark::ui
