#include "ui/main/truth_reader.h"

#include <QComboBox>
#include <QDialog>
#include <QDialogButtonBox>
#include <QFileInfo>
#include <QLabel>
#include <QStatusBar>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "engine/background_job.h"
#include "engine/message_text.h"
#include "imaging/results/segments.h"
#include "ui/main/ask_for_labels.h"
#include "ui/main/main_window.h"
#include "ui/main/panel_docks.h"
#include "ui/main/status_bar.h"
#include "ui/widgets/path_text.h"
#include "ui/widgets/status_progress.h"

namespace tidemark::ui {
namespace {

const char* const kAboutTruth = "comparison with a mask";

}  // namespace

TruthReader::TruthReader(MainWindow& window)
    : QObject(&window), window_(window), progress_(new StatusProgress(*window.statusBar())) {
  connect(window.actions().compare_with_mask, &QAction::triggered, this, [this] {
    if (CaseWindow* active = window_.active_case()) {
      ask_for_labels(window_, *active, tr("Compare with a mask"),
                     [this](CaseWindow& of, const QString& file) { read(of, file); });
    }
  });
  connect(window.actions().compare_with_label, &QAction::triggered, this, [this] {
    if (CaseWindow* active = window_.active_case()) compare_with_label(*active);
  });
  connect(window.actions().stop_comparing, &QAction::triggered, this, [this] {
    if (CaseWindow* active = window_.active_case()) active->proxy().compare_as_the_study();
  });
  progress_->follow(jobs_);
  connect(&jobs_, &engine::ResultJobs::labels_read, this, &TruthReader::choose);
  connect(&jobs_, &engine::ResultJobs::cancelled, this, [this] { end(); });
  connect(&jobs_, &engine::ResultJobs::failed, this, &TruthReader::end);
}

TruthReader::~TruthReader() {
  for (const auto& job : jobs_of_) job->abandon();
}

void TruthReader::read(CaseWindow& window, const QString& file) {
  if (jobs_.busy()) return window_.tell(tr("A mask is being read already."), kAboutTruth);
  read_ = {&window, file};
  progress_->begin(tr("Reading %1").arg(QFileInfo(file).fileName()));
  engine::CaseProxy& proxy = window.proxy();
  jobs_.read_labels(path_of(file), proxy.volume().geometry, false, proxy.study().frame_of_reference_uid);
}

void TruthReader::end(const QString& problem) {
  progress_->hide();
  if (read_.of && !problem.isEmpty()) window_.tell(*read_.of, problem, kAboutTruth);
}

void TruthReader::choose(const std::shared_ptr<const imaging::Segments>& segments) {
  end();
  if (!read_.of) return;
  const QString file = QFileInfo(read_.file).fileName();
  const QString changes = engine::message_text(segments->changes);
  if (!changes.isEmpty()) window_.tell(*read_.of, tr("%1: %2").arg(file, changes));
  if (segments->list.size() == 1) return compare(read_, segments, {});
  QStringList names{tr("All of them together")};
  for (std::size_t i = 0; i < segments->list.size(); ++i)
    names << tr("%1: %2").arg(i + 1).arg(QString::fromStdString(segments->list[i].name));
  auto* dialog = new QDialog(&window_);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setObjectName(QStringLiteral("true-region"));
  dialog->setWindowTitle(tr("Compare with a mask"));
  auto* regions = new QComboBox;
  regions->addItems(names);
  regions->setCurrentIndex(1);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel);
  auto* rows = new QVBoxLayout(dialog);
  auto* question = new QLabel(
      tr("%1 has %2 regions. Which is the true one?").arg(file, QString::number(segments->list.size())));
  question->setTextFormat(Qt::PlainText);
  rows->addWidget(question);
  rows->addWidget(regions);
  rows->addWidget(buttons);
  connect(buttons, &QDialogButtonBox::accepted, dialog, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, dialog, &QDialog::reject);
  connect(dialog, &QDialog::accepted, this, [this, subject = read_, segments, regions] {
    const int index = regions->currentIndex();
    compare(subject, segments, index > 0 ? std::optional(static_cast<std::size_t>(index) - 1) : std::nullopt);
  });
  dialog->open();
}

void TruthReader::compare(const Subject& subject, const std::shared_ptr<const imaging::Segments>& segments,
                          std::optional<std::size_t> region) {
  if (!subject.of) return;
  const QString file = QFileInfo(subject.file).fileName();
  const QString name =
      region ? tr("%1 of %2").arg(QString::fromStdString(segments->list[*region].name), file) : file;
  compare(*subject.of, name, [segments, region] {
    return BitMask(imaging::union_of(
        region ? imaging::Segments{segments->geometry, {segments->list[*region]}, {}} : *segments));
  });
}

void TruthReader::compare_with_label(CaseWindow& window) {
  const engine::CaseProxy& proxy = window.proxy();
  const document::Label* label = proxy.chosen_label();
  if (!label) return;
  compare(window, QString::fromStdString(label->name),
          [grid = proxy.volume().geometry, voxels = proxy.state().label_voxels, id = label->id] {
            return BitMask(grid, voxels ? Region(*voxels, id) : Region());
          });
}

void TruthReader::compare(CaseWindow& of, const QString& name, std::function<BitMask()> make) {
  auto& job_of_case = jobs_of_[&of];
  if (job_of_case) job_of_case->abandon();
  const QPointer alive(&of);
  job_of_case = engine::BackgroundJob::start(
      this,
      [this, name, alive, make = std::move(make)](engine::BackgroundJob& job) {
        auto truth = std::make_shared<const BitMask>(make());
        if (truth->count() == 0) truth = nullptr;
        job.deliver([this, truth, name, alive] {
          if (alive) take(*alive, truth, name);
        });
      },
      [this, alive](const Error& error) {
        if (alive) window_.tell(*alive, engine::message_text(error), kAboutTruth);
      });
}

void TruthReader::take(CaseWindow& of, const std::shared_ptr<const BitMask>& truth, const QString& name) {
  if (!truth) {
    return window_.tell(of, tr("%1 has no voxel inside: there is nothing to compare with.").arg(name),
                        kAboutTruth);
  }
  window_.dismiss_about(kAboutTruth);
  of.proxy().compare_with(truth);
  of.proxy().display().change([](engine::DisplaySettings& settings) { settings.truth = true; });
  if (&of == window_.active_case()) window_.panels().show("level-set");
  window_.statusBar()->showMessage(tr("Compared with %1").arg(name), kShownMs);
}

}  // namespace tidemark::ui
