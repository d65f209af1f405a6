#include "ui/main/case_results.h"

#include <QFileInfo>
#include <QStatusBar>
#include <utility>

#include "engine/message_text.h"
#include "imaging/pacs/configuration.h"
#include "imaging/results/segments.h"
#include "ui/main/ask_for_labels.h"
#include "ui/main/case_exports.h"
#include "ui/main/main_window.h"
#include "ui/main/panel_docks.h"
#include "ui/main/status_bar.h"
#include "ui/readers/readers_dialog.h"
#include "ui/results/deidentify_dialog.h"
#include "ui/results/send_result_dialog.h"
#include "ui/results/write_result_dialog.h"
#include "ui/widgets/path_text.h"
#include "ui/widgets/status_progress.h"

namespace tidemark::ui {
namespace {

const char* const kAboutImport = "import of labels";

}  // namespace

CaseResults::CaseResults(MainWindow& window)
    : QObject(&window), window_(window), progress_(new StatusProgress(*window.statusBar())) {
  connect_jobs();
  Actions& actions = window.actions();
  const auto with_case = [this](QAction* action, auto act) {
    connect(action, &QAction::triggered, this, [this, act] {
      if (CaseWindow* active = window_.active_case()) act(*active);
    });
  };
  const auto writes = [&](QAction* action, ResultFile kind) {
    with_case(action, [this, kind, name = action->objectName()](CaseWindow& of) {
      auto* dialog = new_dialog<WriteResultDialog>(of, name, kind);
      if (!dialog) return;
      connect(dialog, &WriteResultDialog::written, this, [this](const QString& file) {
        window_.statusBar()->showMessage(tr("Wrote %1").arg(file), kShownMs);
      });
    });
  };
  writes(actions.export_segmentation, ResultFile::segmentation);
  writes(actions.export_structure_set, ResultFile::structure_set);
  writes(actions.export_level_set, ResultFile::level_set);
  writes(actions.export_label_meshes, ResultFile::meshes);
  with_case(actions.import_labels, [this](CaseWindow& into) {
    ask_for_labels(window_, into, tr("Import labels"),
                   [this](CaseWindow& of, const QString& file) { import_labels(of, file); });
  });
  with_case(actions.send_result, [this, name = actions.send_result->objectName()](CaseWindow& of) {
    new_dialog<SendResultDialog>(of, name, imaging::pacs_configuration_file());
  });
  with_case(actions.compare_readers, [this](CaseWindow& of) { compare_readers(of); });
  connect(actions.deidentify, &QAction::triggered, this, &CaseResults::make_anonymous_copies);
}

// It goes on when its case is closed. One that waits may be of another case than the user sees now.
void CaseResults::make_anonymous_copies() {
  auto* dialog = window_.findChild<DeidentifyDialog*>();
  if (dialog && !dialog->working()) delete std::exchange(dialog, nullptr);
  if (!dialog) {
    CaseWindow* active = window_.active_case();
    dialog = new DeidentifyDialog(active ? &active->proxy().study() : nullptr, &window_);
    connect(dialog, &DeidentifyDialog::copies_asked_for, &window_, &MainWindow::open);
    dialog->show();
  }
  dialog->raise();
  dialog->activateWindow();
}

void CaseResults::compare_readers(CaseWindow& window) {
  auto* dialog = new_dialog<ReadersDialog>(window, window_.actions().compare_readers->objectName());
  if (!dialog) return;
  connect(dialog, &ReadersDialog::files_wanted, this, [dialog, of = &window] {
    ask_for_labels(
        *dialog, *of, tr("Segmentations of readers"),
        [dialog](CaseWindow&, const QString& file) { dialog->read(file); }, QFileDialog::ExistingFiles);
  });
  connect(dialog, &ReadersDialog::export_wanted, this,
          [this, of = &window](const std::string& csv) { window_.exports().export_comparison(*of, csv); });
}

template <class Dialog, class... Arguments>
Dialog* CaseResults::new_dialog(CaseWindow& window, const QString& name, Arguments... arguments) {
  if (auto* before = window.findChild<Dialog*>(name)) {
    before->raise();
    before->activateWindow();
    return nullptr;
  }
  auto* dialog = new Dialog(window, arguments...);
  dialog->setObjectName(name);
  dialog->show();
  return dialog;
}

void CaseResults::connect_jobs() {
  progress_->follow(jobs_);
  connect(&jobs_, &engine::ResultJobs::labels_read, this, &CaseResults::add);
  connect(&jobs_, &engine::ResultJobs::cancelled, this, [this] { end_reading(); });
  connect(&jobs_, &engine::ResultJobs::failed, this, &CaseResults::end_reading);
  connect(&jobs_, &engine::ResultJobs::no_result, this, [this] {
    window_.open(waiting_.front().file);
    end_reading();
  });
}

void CaseResults::import_labels(CaseWindow& window, const QString& file) {
  read(window, file, false);
}

void CaseResults::take_dropped(const QStringList& paths, CaseWindow* onto) {
  if (onto) window_.bring_to_front(*onto);
  CaseWindow* into = onto ? onto : window_.active_case();
  for (const QString& path : paths) {
    into&& QFileInfo(path).isFile() ? read(*into, path, true) : window_.open(path);
  }
}

// Files that are dropped together are read one after the other.
void CaseResults::read(CaseWindow& window, const QString& file, bool only_results) {
  waiting_.push_back({&window, file, only_results});
  if (waiting_.size() == 1) read_next();
}

void CaseResults::read_next() {
  const Reading& next = waiting_.front();
  if (!next.window) return end_reading();
  progress_->begin(tr("Reading %1").arg(QFileInfo(next.file).fileName()));
  const engine::CaseProxy& proxy = next.window->proxy();
  jobs_.read_labels(path_of(next.file), proxy.volume().geometry, next.only_results,
                    proxy.study().frame_of_reference_uid);
}

void CaseResults::end_reading(const QString& problem) {
  CaseWindow* of = waiting_.front().window;
  if (of && !problem.isEmpty()) window_.tell(*of, problem, kAboutImport);
  progress_->hide();
  waiting_.pop_front();
  if (!waiting_.empty()) read_next();
}

void CaseResults::add(const std::shared_ptr<const imaging::Segments>& segments) {
  if (CaseWindow* into = waiting_.front().window) {
    into->proxy().import_labels(segments);
    window_.dismiss_about(kAboutImport);
    if (into == window_.active_case()) window_.panels().show("labels");
    const QString name = QFileInfo(waiting_.front().file).fileName();
    window_.statusBar()->showMessage(
        tr("Read %n labels from %1", nullptr, static_cast<int>(segments->list.size())).arg(name), kShownMs);
    const QString changes = engine::message_text(segments->changes);
    if (!changes.isEmpty()) window_.tell(*into, tr("%1: %2").arg(name, changes));
  }
  end_reading();
}

}  // namespace tidemark::ui
