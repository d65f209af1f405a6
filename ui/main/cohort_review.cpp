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
#include "imaging/audit/event.h"
#include "ui/cohort/case_opener.h"
#include "ui/cohort/cohort_model.h"
#include "ui/cohort/cohort_panel.h"
#include "ui/main/case_files.h"
#include "ui/main/main_window.h"
#include "ui/main/side_dock.h"
#include "ui/settings.h"
#include "ui/widgets/path_text.h"
#include "ui/widgets/work_line.h"

namespace tidemark::ui {
namespace {

using namespace std::chrono_literals;

constexpr const char* kAboutCohort = "cohort";
constexpr int kNoticeMs = 4000;

cohort::CohortFolder folder_of(const QString& path) {
  return cohort::CohortFolder(path_of(path));
}

// The state whose surface that one has: changes of labels leave the surface as it was.
std::uint64_t state_of_surface(const engine::HistoryRows& rows, std::uint64_t id) {
  // Parents come before their children.
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
    const document::HistoryState& state = row->state;
    if (state.id == id && state.parent && document::is_of_labels(state.change.kind)) id = *state.parent;
  }
  return id;
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
  connect(actions.show_cohort, &QAction::triggered, this, [this] {
    if (dock_) dock_->show();
  });
  connect(actions.reject_case, &QAction::triggered, this, [this] {
    if (const int row = meant_row(); row >= 0) say(row, Verdict::rejected, panel_->comment());
  });
  follow_case();
}

// The cohort.

bool CohortReview::is_cohort(const QString& folder) {
  return QFileInfo(folder).isDir() && folder_of(folder).is_planned() &&
         QFileInfo::exists(text_of(folder_of(folder).work_list()));
}

void CohortReview::ask_and_open() {
  const QString folder =
      QFileDialog::getExistingDirectory(&window_, tr("Open a cohort"), settings::save_folder().get());
  if (!folder.isEmpty()) open(folder);
}

void CohortReview::open(const QString& folder) {
  read({folder, {}, nullptr});
}

void CohortReview::read(const KeptCohort& wanted) {
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
      const KeptCohort now = *std::exchange(wanted_, std::nullopt);
      show(std::move(**list), now);
    });
  };
  reading_ = engine::BackgroundJob::start(this, work, fail);
}

void CohortReview::show(cohort::ReviewList list, const KeptCohort& wanted) {
  close();
  window_.dismiss_about(kAboutCohort);
  path_ = wanted.folder;
  plan_ = std::make_shared<const cohort::CohortPlan>(std::move(list.plan));
  model_ = std::make_unique<CohortModel>(folder_of(path_), std::move(list.entries));
  const Actions& actions = window_.actions();
  panel_ = new CohortPanel(
      *model_, {actions.previous_case, actions.next_case, actions.accept_case, actions.reject_case});
  // The panel may go away with what is asked for.
  connect(panel_, &CohortPanel::open_wanted, this, &CohortReview::open_case, Qt::QueuedConnection);
  connect(panel_, &CohortPanel::close_wanted, this, &CohortReview::close, Qt::QueuedConnection);
  connect(panel_, &CohortPanel::chosen, this, &CohortReview::follow_case);
  connect(panel_, &CohortPanel::commented, this,
          [this](int row, const QString& comment) { say(row, model_->at(row).decision.verdict, comment); });
  connect(&panel_->work(), &WorkLine::cancelled, this, &CohortReview::give_up);
  if (!dock_) dock_ = make_side_dock(window_, "cohort", tr("Cohort"));
  dock_->setWidget(panel_);
  dock_->show();
  if (const int row = model_->row_of(wanted.chosen); row >= 0) panel_->choose(row);
  if (wanted.open && wanted.open->window && model_->row_of(wanted.open->id) >= 0) take_case(wanted.open);
  follow_case();
  if (list.unreadable.empty()) return;
  window_.tell(
      tr("%1. Files that cannot be read: %2.")
          .arg(engine::message_text(list.unreadable.front()), QString::number(list.unreadable.size())),
      kAboutCohort);
}

// The open case stays open, as any other.
void CohortReview::close() {
  if (path_.isEmpty()) return;
  opener_->cancel();
  opening_ = -1;
  delete panel_;  // it keeps the comment that is being typed
  open_.reset();
  correcting_ = false;
  closes_later_ = false;
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
  if (panel_) panel_->keep_comment();
  writing_.wait(2s);
  return present();
}

KeptCohort CohortReview::present() const {
  if (wanted_) return *wanted_;
  if (path_.isEmpty()) return {};
  const int row = panel_->row();
  return {path_, row >= 0 ? model_->at(row).row.id : std::string(), open_window() ? open_ : nullptr};
}

void CohortReview::take_over(const KeptCohort& kept) {
  if (kept.folder.isEmpty()) return;
  for (CaseWindow* window : window_.cases()) {
    if (kept.open && &window->proxy() == kept.open->proxy) kept.open->window = window;
  }
  read(kept);
}

// Its cases.

void CohortReview::follow_case() {
  const Actions& actions = window_.actions();
  const int row = panel_ && !correcting_ ? meant_row() : -1;
  const bool has_result =
      row >= 0 && model_->at(row).status && model_->at(row).status->outcome == cohort::CaseOutcome::done;
  const bool corrects = row >= 0 && is_changed();
  actions.next_case->setEnabled(panel_ != nullptr);
  actions.show_cohort->setEnabled(panel_ != nullptr);
  actions.previous_case->setEnabled(panel_ != nullptr);
  actions.accept_case->setEnabled(has_result || corrects);
  actions.reject_case->setEnabled(row >= 0);
  if (panel_) panel_->set_correction(corrects);
}

// One that is closed is there for a moment longer.
CaseWindow* CohortReview::open_window() const {
  CaseWindow* window = open_ ? open_->window.data() : nullptr;
  return window_.cases().contains(window) ? window : nullptr;
}

int CohortReview::open_row() const {
  return open_window() ? model_->row_of(open_->id) : -1;
}

bool CohortReview::is_changed() const {
  CaseWindow* window = open_window();
  if (!window || !window->proxy().state().begun) return false;
  const engine::CaseState& state = window->proxy().state();
  if (!open_->result || state.open_change) return true;
  return state_of_surface(*state.history, state.history_state) !=
         state_of_surface(*state.history, *open_->result);
}

int CohortReview::meant_row() const {
  const int row = panel_->row();
  if (!open_window()) return window_.active_case() == nullptr ? row : -1;
  return row == open_row() && window_.active_case() == open_window() ? row : -1;
}

void CohortReview::go(int by) {
  if (!panel_) return;
  const int row = panel_->row() + by;
  if (row >= 0 && row < model_->rowCount()) return open_case(row);
  window_.statusBar()->showMessage(by > 0 ? tr("This is the last case.") : tr("This is the first case."),
                                   kNoticeMs);
}

void CohortReview::open_case(int row) {
  if (!panel_ || row >= model_->rowCount()) return;
  if (opening_ >= 0) give_up();
  if (row == open_row()) {
    panel_->choose(row);
    return window_.bring_to_front(*open_window());
  }
  const std::string id = model_->at(row).row.id;
  if (correcting_) {
    after_it_ = id;
    return;
  }
  if (!is_changed()) return load(row);
  QMessageBox box(
      QMessageBox::Question, tr("Cohort"),
      tr("The surface of %1 was changed. Is it the correct one?").arg(QString::fromStdString(open_->id)),
      QMessageBox::Discard | QMessageBox::Cancel, &window_);
  box.setTextFormat(Qt::PlainText);
  QAbstractButton* accepted = box.addButton(tr("Accept the correction"), QMessageBox::AcceptRole);
  const auto asked = open_;
  box.exec();
  // Meanwhile the case, or the cohort, may have gone.
  if (!open_window() || asked != open_) return;
  panel_->choose(open_row());
  if (box.clickedButton() == accepted) {
    after_it_ = id;
    return correct();
  }
  if (box.standardButton(box.clickedButton()) != QMessageBox::Discard) return;
  // Labels, images and measurements are not the surface: with those of the user's own the case stays, as any
  // other.
  CaseWindow& left = *open_window();
  if (left.proxy().state().labels.empty() && left.proxy().has_saved_attachments()) left.close_saved();
  if (const int wanted = model_->row_of(id); wanted >= 0) load(wanted);
}

// The case that is open stays until the next one is there.
void CohortReview::load(int row) {
  opening_ = row;
  panel_->choose(row);
  panel_->work().begin(tr("Opening %1").arg(QString::fromStdString(model_->at(row).row.id)));
  opener_->open(folder_of(path_), *plan_, model_->at(row));
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
  window_.dismiss_about(kAboutCohort);
  const QPointer before(open_window());
  const bool is_free = before && !is_changed();
  // Computed as a run would go on, so that the recipe makes the same voxels everywhere.
  CaseWindow* opened = window_.add_case(study, {contents, false}, solver::ExecutorKind::host);
  const cohort::ReviewEntry& entry = model_->at(row);
  auto open =
      std::make_shared<CohortCase>(CohortCase{entry.row.id, &opened->proxy(), opened, {}, entry.status});
  if (contents) open->result = contents->history.present;
  take_case(std::move(open));
  if (is_free) leave(*before);
  // The panels of the first case bring back an arrangement that knows of no cohort.
  const auto show = [this] {
    if (panel_) dock_->show();
  };
  QMetaObject::invokeMethod(this, show, Qt::QueuedConnection);
}

void CohortReview::take_case(std::shared_ptr<CohortCase> open) {
  open_ = std::move(open);
  // Once it is gone: while it is being destroyed it is no case window any more.
  connect(open_->window, &QObject::destroyed, this, &CohortReview::follow_closing, Qt::QueuedConnection);
  follow_case();
}

// Without the case there is no snapshot of it.
void CohortReview::follow_closing() {
  if (correcting_ && !is_written_ && !open_window()) end_correction(cancelled_error());
  follow_case();
}

// With anything that the cohort does not keep, such as labels, it stays, as any other case.
void CohortReview::leave(CaseWindow& window) {
  window.proxy().after_commands([leaving = QPointer(&window)] {
    if (leaving && !leaving->proxy().state().modified) leaving->close_saved();
  });
}

// What is said.

void CohortReview::accept() {
  const int row = panel_ && !correcting_ ? meant_row() : -1;
  if (row < 0) return;
  if (is_changed()) return correct();
  say(row, Verdict::accepted, panel_->comment());
}

void CohortReview::correct() {
  CaseWindow& window = *open_window();
  window.proxy().pause();
  panel_->keep_comment();
  panel_->work().begin(tr("Writing the correction"));
  correcting_ = true;
  is_written_ = false;
  follow_case();
  const auto write = [this, open = open_](const auto& snapshot) {
    if (correcting_ && open == open_) write_correction(snapshot);
  };
  const auto give_up = [this, open = open_] {
    if (correcting_ && open == open_) end_correction(cancelled_error());
  };
  window.proxy().take_snapshot(window.view_state(), write, give_up);
}

// The correction, and that it was accepted, are one piece of work: neither is written alone.
void CohortReview::write_correction(const std::shared_ptr<const engine::CaseProxy::Snapshot>& snapshot) {
  is_written_ = true;
  const engine::CaseProxy& proxy = open_->window->proxy();
  const cohort::ReviewEntry entry = model_->at(open_row());
  const cohort::Decision decision{entry.row.id, Verdict::accepted, entry.decision.comment};
  const auto status = std::make_shared<cohort::CaseStatus>();
  const auto work =
      [entry, decision, status, snapshot, seen = open_->seen, folder = folder_of(path_), plan = plan_,
       study = proxy.shared_study(), source = proxy.source(),
       program = QCoreApplication::applicationVersion().toStdString()](const Progress& progress) -> Status {
    const document::SessionContents& contents = snapshot->contents;
    const solver::SurfaceStatistics surface = solver::measure(*contents.phi);
    const cohort::CaseResult result{*source, *contents.phi, surface, contents.recipe, study->dicom_files};
    auto made = cohort::correct_case(folder, *plan, entry.row, seen, result, program, progress);
    const Status corrected = made ? Status() : Status(tl::unexpected<Error>(made.error()));
    TIDEMARK_TRY(imaging::exported(corrected, study->audited, {folder.case_folder(entry.row.id)}));
    *status = std::move(*made);
    return cohort::decide(folder, entry.decision, decision);
  };
  const auto ended = [this, decision, status, snapshot, open = open_, path = path_](const Status& written) {
    if (path != path_ || open != open_) return;
    if (!status->id.empty()) {
      model_->set_status(*status);
      open->seen = *status;
      open->result = snapshot->position;
      // The cohort keeps neither labels nor what lies beside the history.
      if (open->window && snapshot->contents.labels.empty())
        open->window->proxy().mark_surface_saved(snapshot->position);
    }
    if (written) model_->set_decision(decision);
    end_correction(written);
  };
  writing_.add(work, ended);
}

void CohortReview::end_correction(const Status& written) {
  correcting_ = false;
  const std::string next = std::exchange(after_it_, {});
  const bool closes = std::exchange(closes_later_, false);
  if (panel_) panel_->work().end({});
  follow_case();
  if (!written) {
    if (written.error().kind == ErrorKind::cancelled) return;
    window_.tell(engine::message_text(written.error()), kAboutCohort);
    // Somebody else has changed the case. This one stays open, as any other.
    const std::string id = open_ ? open_->id : std::string();
    if (written.error().kind == ErrorKind::usage && !path_.isEmpty()) read({path_, id, nullptr});
    return;
  }
  if (closes) QMetaObject::invokeMethod(&window_, &QWidget::close, Qt::QueuedConnection);
  if (const int row = model_->row_of(next); row >= 0) open_case(row);
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
    if (path == path_) read(present());  // as somebody else has left it
  });
}

}  // namespace tidemark::ui
