#include "ui/main/cohort_review.h"

#include <QCoreApplication>
#include <QDockWidget>
#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <QPushButton>
#include <QStatusBar>
#include <chrono>

#include "core/without_exceptions.h"
#include "document/cohort/correction.h"
#include "engine/background_job.h"
#include "engine/message_text.h"
#include "ui/cohort/case_opener.h"
#include "ui/cohort/cohort_model.h"
#include "ui/cohort/cohort_panel.h"
#include "ui/main/case_files.h"
#include "ui/main/main_window.h"
#include "ui/settings.h"
#include "ui/widgets/relative_font.h"
#include "ui/widgets/work_line.h"

namespace tidemark::ui {
namespace {

using namespace std::chrono_literals;

constexpr int kWidth = 340;  // logical pixels
constexpr const char* kAboutCohort = "cohort";
constexpr int kNoticeMs = 4000;

cohort::CohortFolder folder_of(const QString& path) {
  return cohort::CohortFolder(path_of(path));
}

}  // namespace

CohortReview::CohortReview(MainWindow& window)
    : QObject(&window), window_(window), opener_(std::make_unique<CaseOpener>()), writing_(this) {
  connect_actions();
  connect(opener_.get(), &CaseOpener::opened, this, &CohortReview::add);
  connect(opener_.get(), &CaseOpener::progressed, this, [this](double fraction, const QString& step) {
    if (panel_) panel_->work().set_progress(fraction, step);
  });
  connect(opener_.get(), &CaseOpener::failed, this, [this](const QString& message) {
    opening_ = -1;
    if (panel_) panel_->work().end({});
    window_.tell(message, kAboutCohort);
    follow_case();
  });
}

CohortReview::~CohortReview() {
  if (reading_) reading_->abandon();
  delete panel_;  // it keeps the comment that is being typed
}

void CohortReview::connect_actions() {
  const Actions& actions = window_.actions();
  connect(actions.open_cohort, &QAction::triggered, this, &CohortReview::ask_and_open);
  // A question that is asked then may outlive the button.
  connect(
      actions.next_case, &QAction::triggered, this, [this] { go(1); }, Qt::QueuedConnection);
  connect(
      actions.previous_case, &QAction::triggered, this, [this] { go(-1); }, Qt::QueuedConnection);
  connect(actions.accept_case, &QAction::triggered, this, &CohortReview::accept);
  connect(actions.reject_case, &QAction::triggered, this, [this] {
    if (const int row = meant_row(); row >= 0) say(row, Verdict::rejected, panel_->comment());
  });
  follow_case();
}

// The cohort.

bool CohortReview::is_cohort(const QString& folder) {
  return QFileInfo(folder).isDir() && folder_of(folder).is_planned() &&
         QFileInfo::exists(QString::fromStdU16String(folder_of(folder).work_list().u16string()));
}

void CohortReview::ask_and_open() {
  const QString folder =
      QFileDialog::getExistingDirectory(&window_, tr("Open a cohort"), settings::save_folder().get());
  if (!folder.isEmpty()) open(folder);
}

void CohortReview::open(const QString& folder) {
  read({folder, {}, {}, nullptr});
}

void CohortReview::read(const Wanted& wanted) {
  if (reading_) reading_->abandon();
  wanted_ = wanted;
  const auto fail = [this](const Error& error) {
    wanted_.reset();
    window_.tell(engine::message_text(error), kAboutCohort);
  };
  const auto work = [this, fail, folder = wanted.folder](engine::BackgroundJob& job) {
    auto list = std::make_shared<Result<cohort::ReviewList>>(without_exceptions([&] {
      return cohort::load_review_list(folder_of(folder), {nullptr, job.stop()});
    }));
    job.deliver([this, fail, list] {
      reading_.reset();
      if (!*list) return fail(list->error());
      const Wanted now = *std::exchange(wanted_, std::nullopt);
      show(std::move(**list), now);
    });
  };
  reading_ = engine::BackgroundJob::start(this, work, fail);
}

// Somebody else has changed it.
void CohortReview::read_again() {
  const KeptCohort now = keep();
  read({now.folder, now.chosen, now.open, case_});
}

void CohortReview::show(cohort::ReviewList list, const Wanted& wanted) {
  close();
  window_.settle(kAboutCohort);
  path_ = wanted.folder;
  plan_ = std::make_shared<const cohort::CohortPlan>(std::move(list.plan));
  model_ = std::make_unique<CohortModel>(folder_of(path_), std::move(list.entries));
  const Actions& actions = window_.actions();
  panel_ = new CohortPanel(
      *model_, {actions.previous_case, actions.next_case, actions.accept_case, actions.reject_case});
  // The panel may go away with what is asked for.
  connect(panel_, &CohortPanel::open_wanted, this, &CohortReview::open_row, Qt::QueuedConnection);
  connect(panel_, &CohortPanel::close_wanted, this, &CohortReview::close, Qt::QueuedConnection);
  connect(panel_, &CohortPanel::chosen, this, &CohortReview::follow_case);
  connect(panel_, &CohortPanel::commented, this,
          [this](int row, const QString& comment) { say(row, model_->at(row).decision.verdict, comment); });
  connect(&panel_->work(), &WorkLine::cancelled, this, &CohortReview::give_up);
  if (!dock_) {
    dock_ = new QDockWidget(tr("Cohort"), &window_);
    dock_->setObjectName("cohort");
    let_title_follow_font(*dock_);
    dock_->setMinimumWidth(kWidth);
    window_.addDockWidget(Qt::LeftDockWidgetArea, dock_);
  }
  dock_->setWidget(panel_);
  dock_->show();
  if (const int row = model_->row_of(wanted.chosen); row >= 0) panel_->choose(row);
  if (const int row = model_->row_of(wanted.open); row >= 0 && wanted.window) take_case(wanted.window, row);
  follow_case();
  if (list.unreadable.empty()) return;
  window_.tell(tr("%1. Files that cannot be read: %2.")
                   .arg(engine::message_text(list.unreadable.front()))
                   .arg(list.unreadable.size()),
               kAboutCohort);
}

// The open case stays open, as any other.
void CohortReview::close() {
  if (path_.isEmpty()) return;
  opener_->cancel();
  opening_ = -1;
  delete panel_;  // it keeps the comment that is being typed
  case_ = nullptr;
  case_row_ = -1;
  result_.reset();
  correcting_ = false;
  after_it_.clear();
  model_.reset();
  plan_.reset();
  path_.clear();
  dock_->hide();
  follow_case();
}

bool CohortReview::may_close() {
  if (panel_) panel_->keep_comment();
  if (!correcting_) return true;
  closes_later_ = true;
  return false;
}

KeptCohort CohortReview::keep() {
  if (wanted_)
    return {wanted_->folder, wanted_->chosen, wanted_->open,
            wanted_->window ? &wanted_->window->proxy() : nullptr};
  if (path_.isEmpty()) return {};
  panel_->keep_comment();
  writing_.wait(2s);
  const int row = panel_->row();
  KeptCohort kept{path_, row >= 0 ? model_->at(row).row.id : std::string(), {}, nullptr};
  if (case_) {
    kept.open = model_->at(case_row_).row.id;
    kept.opened = &case_->proxy();
  }
  return kept;
}

void CohortReview::take_over(const KeptCohort& kept) {
  if (kept.folder.isEmpty()) return;
  Wanted wanted{kept.folder, kept.chosen, kept.open, nullptr};
  for (CaseWindow* window : window_.cases()) {
    if (&window->proxy() == kept.opened) wanted.window = window;
  }
  read(wanted);
}

// Its cases.

void CohortReview::follow_case() {
  const Actions& actions = window_.actions();
  const int row = panel_ && !correcting_ ? meant_row() : -1;
  const bool has_result =
      row >= 0 && model_->at(row).status && model_->at(row).status->outcome == cohort::CaseOutcome::done;
  const bool corrects = row >= 0 && is_changed();
  actions.next_case->setEnabled(panel_ != nullptr);
  actions.previous_case->setEnabled(panel_ != nullptr);
  actions.accept_case->setEnabled(has_result || corrects);
  actions.reject_case->setEnabled(row >= 0);
  if (panel_) panel_->set_correction(corrects);
}

bool CohortReview::is_changed() const {
  if (!case_ || !case_->proxy().state().begun) return false;
  const engine::CaseState& state = case_->proxy().state();
  return result_ != Surface(state.step, state.steered);
}

int CohortReview::meant_row() const {
  const int row = panel_->row();
  if (!case_) return window_.active_case() == nullptr ? row : -1;
  return row == case_row_ && window_.active_case() == case_ ? row : -1;
}

void CohortReview::go(int by) {
  if (!panel_) return;
  const int row = panel_->row() + by;
  if (row >= 0 && row < model_->rowCount()) return open_row(row);
  window_.statusBar()->showMessage(by > 0 ? tr("This is the last case.") : tr("This is the first case."),
                                   kNoticeMs);
}

void CohortReview::open_row(int row) {
  if (!panel_ || row >= model_->rowCount()) return;
  if (opening_ >= 0) give_up();
  if (case_ && row == case_row_) {
    panel_->choose(row);
    return window_.bring_to_front(*case_);
  }
  const std::string id = model_->at(row).row.id;
  if (correcting_) {
    after_it_ = id;
    return;
  }
  if (!is_changed()) return load(row);
  QMessageBox box(QMessageBox::Question, tr("Cohort"),
                  tr("The surface of %1 was changed. Is it the correct one?")
                      .arg(QString::fromStdString(model_->at(case_row_).row.id)),
                  QMessageBox::Discard | QMessageBox::Cancel, &window_);
  QAbstractButton* accepted = box.addButton(tr("Accept the correction"), QMessageBox::AcceptRole);
  const QPointer asked(case_);
  box.exec();
  // Meanwhile the case, or the cohort, may have gone.
  if (!asked || asked != case_) return;
  panel_->choose(case_row_);
  if (box.clickedButton() == accepted) {
    after_it_ = id;
    return correct();
  }
  if (box.standardButton(box.clickedButton()) != QMessageBox::Discard) return;
  leave(*case_);
  if (const int wanted = model_->row_of(id); wanted >= 0) load(wanted);
}

// The case that is open stays until the next one is there.
void CohortReview::load(int row) {
  opening_ = row;
  panel_->choose(row);
  panel_->work().begin(tr("Opening %1").arg(QString::fromStdString(model_->at(row).row.id)));
  opener_->open(folder_of(path_), model_->at(row));
  follow_case();
}

// What the line of work tells of.
void CohortReview::give_up() {
  if (opening_ < 0) return writing_.stop_present();
  opener_->cancel();
  opening_ = -1;
  panel_->work().end({});
  follow_case();
}

void CohortReview::add(const std::shared_ptr<const engine::LoadedStudy>& study,
                       const std::shared_ptr<const document::SessionContents>& contents) {
  const int row = std::exchange(opening_, -1);
  panel_->work().end({});
  window_.settle(kAboutCohort);
  const QPointer before(case_);
  const bool is_free = before && !is_changed();
  // Computed as a run would go on, so that the recipe makes the same voxels everywhere.
  CaseWindow* opened = window_.add_case(study, {contents, false}, solver::ExecutorKind::host);
  take_case(opened, row);
  if (contents) result_ = Surface(contents->recipe.steps, contents->recipe.events.size());
  if (is_free) leave(*before);
  // The panels of the first case bring back an arrangement that knows of no cohort.
  const auto show = [this] {
    if (panel_) dock_->show();
  };
  QMetaObject::invokeMethod(this, show, Qt::QueuedConnection);
}

void CohortReview::take_case(CaseWindow* window, int row) {
  case_ = window;
  case_row_ = row;
  result_.reset();
  connect(window, &QObject::destroyed, this, &CohortReview::follow_case);
  follow_case();
}

// With labels of the user's own it stays, as any other case.
void CohortReview::leave(CaseWindow& window) {
  if (window.proxy().state().labels.empty()) window.close_saved();
}

// What is said.

void CohortReview::accept() {
  const int row = panel_ && !correcting_ ? meant_row() : -1;
  if (row < 0) return;
  if (is_changed()) return correct();
  say(row, Verdict::accepted, panel_->comment());
}

void CohortReview::correct() {
  engine::CaseProxy& proxy = case_->proxy();
  proxy.pause();
  panel_->keep_comment();
  panel_->work().begin(tr("Writing the correction"));
  correcting_ = true;
  follow_case();
  const auto write = [this, path = path_, window = QPointer(case_)](const auto& snapshot) {
    if (!correcting_ || !window || window != case_ || path != path_) return;
    write_correction(*window, snapshot);
  };
  const auto give_up = [this, window = QPointer(case_)] {
    if (window == case_) end_correction({});
  };
  proxy.take_snapshot(case_->view_state(), write, give_up);
}

// The correction, and that it was accepted, are one piece of work: neither is written alone.
void CohortReview::write_correction(CaseWindow& window,
                                    const std::shared_ptr<const engine::CaseProxy::Snapshot>& snapshot) {
  const cohort::ReviewEntry entry = model_->at(case_row_);
  const cohort::Decision decision{entry.row.id, Verdict::accepted, entry.decision.comment};
  const auto status = std::make_shared<cohort::CaseStatus>();
  const auto work =
      [entry, decision, status, snapshot, folder = folder_of(path_), plan = plan_,
       study = window.proxy().shared_study(), source = window.proxy().source(),
       program = QCoreApplication::applicationVersion().toStdString()](const Progress& progress) -> Status {
    const document::SessionContents& contents = snapshot->contents;
    const solver::SurfaceStatistics surface = solver::measure(*contents.phi);
    const cohort::CaseResult result{*source, *contents.phi, surface, contents.recipe, study->dicom_files};
    auto made = cohort::correct_case(folder, *plan, entry.row, entry.status, result, program, progress);
    if (!made) return pass_on(made);
    *status = std::move(*made);
    return cohort::decide(folder, entry.decision, decision);
  };
  const auto ended = [this, decision, status, snapshot, path = path_,
                      window = QPointer(&window)](const Status& written) {
    if (path != path_) return;
    if (!status->id.empty()) model_->set_status(*status);
    if (written) model_->set_decision(decision);
    if (written && window && window == case_) {
      const document::Recipe& recipe = snapshot->contents.recipe;
      result_ = Surface(recipe.steps, recipe.events.size());
      // The cohort keeps all of it, but for labels.
      if (snapshot->contents.labels.empty()) window->proxy().mark_saved(*snapshot);
    }
    end_correction(written);
  };
  writing_.add(work, ended);
}

void CohortReview::end_correction(const Status& written) {
  correcting_ = false;
  const std::string next = std::exchange(after_it_, {});
  if (panel_) panel_->work().end({});
  if (!written && written.error().kind != ErrorKind::cancelled)
    window_.tell(engine::message_text(written.error()), kAboutCohort);
  if (written && std::exchange(closes_later_, false))
    QMetaObject::invokeMethod(&window_, &QWidget::close, Qt::QueuedConnection);
  closes_later_ = false;
  follow_case();
  if (!written || !model_) return;
  if (const int row = model_->row_of(next); row >= 0) open_row(row);
}

void CohortReview::say(int row, Verdict verdict, const QString& comment) {
  const cohort::Decision before = model_->at(row).decision;
  const cohort::Decision decision{model_->at(row).row.id, verdict, comment.toStdString()};
  if (decision == before) return;
  model_->set_decision(decision);
  const auto work = [folder = folder_of(path_), before, decision](const Progress&) {
    return cohort::decide(folder, before, decision);
  };
  writing_.add(work, [this, path = path_](const Status& written) {
    if (written) return;
    window_.tell(engine::message_text(written.error()), kAboutCohort);
    if (path == path_) read_again();
  });
}

}  // namespace tidemark::ui
