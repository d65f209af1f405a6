#include "ui/main/main_window.h"

#include <QApplication>
#include <QCloseEvent>
#include <QDragEnterEvent>
#include <QMdiSubWindow>
#include <QMimeData>
#include <QSet>
#include <QStackedWidget>
#include <QUrl>
#include <QVBoxLayout>
#include <algorithm>

#include "engine/message_text.h"
#include "ui/look/about_dialog.h"
#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/main/case_actions.h"
#include "ui/main/case_area.h"
#include "ui/main/case_comparison.h"
#include "ui/main/case_exports.h"
#include "ui/main/case_files.h"
#include "ui/main/case_links.h"
#include "ui/main/case_messages.h"
#include "ui/main/case_results.h"
#include "ui/main/cohort_review.h"
#include "ui/main/film_writer.h"
#include "ui/main/first_steps.h"
#include "ui/main/focus_chain.h"
#include "ui/main/help.h"
#include "ui/main/image_adder.h"
#include "ui/main/keys_dialog.h"
#include "ui/main/leak_message.h"
#include "ui/main/menus.h"
#include "ui/main/message_bar.h"
#include "ui/main/own_keys.h"
#include "ui/main/panel_docks.h"
#include "ui/main/server_query.h"
#include "ui/main/session_reader.h"
#include "ui/main/session_writer.h"
#include "ui/main/status_bar.h"
#include "ui/main/teaching.h"
#include "ui/main/truth_reader.h"
#include "ui/main/unfinished_work.h"
#include "ui/opening/ask_for_study.h"
#include "ui/opening/dropped_paths.h"
#include "ui/opening/load_report.h"
#include "ui/opening/preview_page.h"
#include "ui/opening/recent_studies.h"
#include "ui/opening/start_page.h"
#include "ui/opening/study_link.h"
#include "ui/opening/study_opener.h"
#include "ui/pacs/query_dialog.h"
#include "ui/settings.h"
#include "ui/views/picture_surface.h"
#include "ui/views/picture_view.h"
#include "ui/widgets/path_text.h"
#include "ui/widgets/status_progress.h"

namespace tidemark::ui {
MainWindow::MainWindow(engine::Engine& engine, QWidget* parent) : QMainWindow(parent), engine_(engine) {
  setObjectName("main");
  setWindowTitle(tr("Tidemark"));  // Qt adds the name of a case that fills the window
  setWindowIcon(application_icon());
  setAcceptDrops(true);
  if (engine.pictures() == engine::Engine::Pictures::textures) expect_surfaces(*this);
  resize(QSize(1280, 800).boundedTo(screen()->availableSize()));
  setStatusBar(status_bar_ = new StatusBar(engine));  // before those that add to it
  actions_ = new Actions(this);
  recent_ = new RecentStudies(this);
  opener_ = new StudyOpener(this);
  links_ = new CaseLinks(this);
  comparison_ = new CaseComparison(*this, *links_);
  files_ = new CaseFiles(*this);
  exports_ = new CaseExports(*this, *files_);
  films_ = new FilmWriter(*this, *files_);
  session_reader_ = new SessionReader(*this);
  session_writer_ = new SessionWriter(*this, *files_);
  cohort_ = new CohortReview(*this);
  make_centre();
  panels_ = new PanelDocks(*this, *actions_);
  teaching_ = new Teaching(*this);
  make_menus(*this, *actions_, {recent_, panels_, teaching_});
  make_tool_bar(*this, *actions_);
  results_ = new CaseResults(*this);
  new TruthReader(*this);
  new OwnKeys(this);
  images_ = new ImageAdder(*this);
  connect_case_actions(*this);
  connect_files();
  connect_views();
  connect_windows();
  connect_help();
  restoreGeometry(settings::window_geometry().get());
  panels_->restore(settings::window_state().get());
  follow_case();
}

MainWindow::~MainWindow() {
  // Its cases are destroyed after it; their signals would reach a main window that is no more.
  area_->disconnect(this);
  links_->disconnect(this);
  for (const auto& connection : active_connections_) disconnect(connection);
}

void MainWindow::make_centre() {
  centre_ = new QStackedWidget;
  auto* start = new StartPage(*recent_);
  area_ = new CaseArea;
  centre_->addWidget(start);
  centre_->addWidget(area_);
  new PreviewPage(*centre_, *opener_);
  messages_ = new MessageBar;
  auto* whole = new QWidget;
  auto* layout = new QVBoxLayout(whole);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  layout->addWidget(messages_);
  layout->addWidget(centre_, 1);
  setCentralWidget(whole);
  connect(area_, &QMdiArea::subWindowActivated, this, &MainWindow::activate);
  connect(area_, &CaseArea::case_closed, this, &MainWindow::follow_closing);
  connect(start, &StartPage::open_folder, this, &MainWindow::ask_for_folder);
  connect(start, &StartPage::open_file, this, &MainWindow::ask_for_file);
  connect(start, &StartPage::phantom_chosen, this, &MainWindow::open_phantom);
  connect(start, &StartPage::recent_chosen, this, &MainWindow::open_recent);
  connect(start, &StartPage::lessons_wanted, this, [this](QPoint at) { teaching_->show_list(at); });
  connect(start, &StartPage::dropped, this, [this](const QStringList& paths) {
    for (const QString& path : paths) open(path);
  });
}

// Files.

void MainWindow::connect_files() {
  opener_->show_in(*new StatusProgress(*status_bar_));
  connect(opener_, &StudyOpener::failed, this,
          [this](const QString& message) { tell(message, kAboutOpening); });
  connect(opener_, &StudyOpener::opened, this, [this](const auto& study) { add_case(study); });
  connect(recent_, &RecentStudies::chosen, this, &MainWindow::open_recent);
  connect(actions_->open_folder, &QAction::triggered, this, &MainWindow::ask_for_folder);
  connect(actions_->open_file, &QAction::triggered, this, &MainWindow::ask_for_file);
  connect(actions_->open_session, &QAction::triggered, session_reader_, &SessionReader::ask_and_open);
  connect(session_reader_, &SessionReader::opened, this, &MainWindow::remember);
  connect(session_writer_, &SessionWriter::saved, this, &MainWindow::remember);
  connect(session_writer_, &SessionWriter::not_saved, this, [this] { quitting_ = false; });
  connect(files_, &CaseFiles::ended, this, &MainWindow::quit_at_last);
  connect(films_, &FilmWriter::ended, this, &MainWindow::quit_at_last);
  connect(actions_->quit, &QAction::triggered, this, &QWidget::close);
}

void MainWindow::ask_for_folder() {
  const QString folder = ask_for_study_folder(*this);
  if (!folder.isEmpty()) open(folder);
}

void MainWindow::ask_for_file() {
  const QString file = ask_for_image_file(*this);
  if (!file.isEmpty()) open(file);
}

void MainWindow::open(const QString& path) {
  if (path.startsWith("file:///")) {
    open(QUrl(path).toLocalFile());  // as file managers call a program that opens links
  } else if (StudyLink::is_link(path)) {
    open_link(path);
  } else if (path.endsWith(".tidemark")) {
    session_reader_->open(path);
  } else if (CohortReview::is_cohort(path)) {
    cohort_->open(path);
  } else {
    opener_->open(path);
  }
}

void MainWindow::open_link(const QString& text) {
  const auto link = StudyLink::parse(text);
  if (!link) return tell(engine::message_text(link.error()), kAboutOpening);
  if (!link->path.isEmpty()) return open(link->path);
  const Status asked = query_server(*this).ask(link->server, link->query);
  if (!asked) tell(engine::message_text(asked.error()), kAboutOpening);
}

void MainWindow::open_recent(const RecentStudy& study) {
  if (study.uid.isEmpty()) return open(study.path);  // a session
  opener_->open_series(study.path, study.uid, study.policy);
}

// Its session, among the recent studies.
void MainWindow::remember(CaseWindow& window) {
  recent_->add({window.session_file, {}, window.proxy().name(), {}});
}

void MainWindow::open_phantom(const QString& kind) {
  opener_->open_phantom(kind);
}

CaseWindow* MainWindow::add_case(const std::shared_ptr<const engine::LoadedStudy>& study,
                                 const engine::RestoredCase& restored,
                                 std::optional<solver::ExecutorKind> executor) {
  // The session file is remembered instead of its study.
  const bool from_session = restored.contents && !restored.in_no_file;
  if (!study->origin.path.empty() && !from_session) {
    const RecentStudy recent{QString::fromStdString(study->origin.path.string()),
                             QString::fromStdString(study->origin.series_uid), study->name,
                             study->origin.policy};
    recent_->add(recent);
    recent_->add_picture(recent, study->volume, study->summary.window, study->volume->geometry.size.z / 2);
  }
  auto* window = new CaseWindow(
      std::make_unique<engine::CaseProxy>(engine_, study, executor.value_or(executor_), restored), *actions_);
  window->proxy().display().change([&](engine::DisplaySettings& settings) {
    if (active_) {
      settings.tool = active_->proxy().display().settings().tool;
    } else if (!study->origin.phantom.empty()) {
      settings.tool = engine::Tool::seed;  // to be tried at once: its T and epsilon fit
    }
  });
  dismiss_about(kAboutOpening);
  quitting_ = false;  // nobody was asked about this one
  window->set_number(free_number());
  // The event loop runs between making a case and showing it.
  const auto show = [this, child = QPointer(place(window)), study, restored] {
    if (child) show_case(*child, *study, restored);
  };
  QMetaObject::invokeMethod(this, show, Qt::QueuedConnection);
  return window;
}

QMdiSubWindow* MainWindow::place(CaseWindow* window) {
  new CaseMessages(*window, *messages_);  // its children
  new LeakMessage(*window, *messages_);
  connect(window, &CaseWindow::close_wanted, session_writer_, &SessionWriter::close);
  connect(window, &CaseWindow::activation_wanted, this, [this](CaseWindow& wanted) {
    const QPointer<QWidget> keyboard = QApplication::focusWidget();
    bring_to_front(wanted);
    if (keyboard) keyboard->setFocus();
  });
  connect(window, &CaseWindow::place_panel_wanted, this, [this] { panels_->show("initialise"); });
  return area_->add(window);
}

MainWindow::Kept MainWindow::keep() {
  keep_arrangement();
  Kept kept;
  kept.tabs = actions_->tabs->isChecked();
  kept.panels_hidden = actions_->hide_interface->isChecked();
  kept.large_type = teaching_->large_type();
  kept.executor = executor_;
  kept.lesson = teaching_->keep();
  kept.cohort = cohort_->keep();
  panels_->set_case(nullptr);
  status_bar_->set_proxy(nullptr);
  const CaseWindow* active = std::exchange(active_, nullptr);
  follow_case();
  const QList<CaseWindow*> all = cases();
  kept.active = all.indexOf(active);
  for (qsizetype n = 0; n < all.size(); ++n) {
    if (all[n]->linked()) kept.linked << n;
  }
  links_->unlink();
  for (CaseWindow* window : all) {
    window->disconnect(session_reader_);  // which would take its going for the user's wish
    kept.cases.push_back(window->keep());
  }
  return kept;
}

void MainWindow::take_over(Kept kept) {
  QList<CaseWindow*> taken;
  executor_ = kept.executor;
  actions_->tabs->setChecked(kept.tabs);
  for (KeptCase& one : kept.cases) {
    const QByteArray views = one.views;
    auto* window = new CaseWindow(std::move(one), *actions_);
    taken << window;
    area_->show_child(*place(window));
    window->show_views(views);
  }
  QList<CaseWindow*> linked;
  for (const qsizetype place : kept.linked) linked << taken[place];
  links_->link(linked);
  if (!taken.isEmpty()) centre_->setCurrentWidget(area_);
  if (kept.active >= 0) bring_to_front(*taken[kept.active]);
  cohort_->take_over(kept.cohort);
  if (kept.lesson) teaching_->take_over(std::move(kept.lesson));
  teaching_->set_large_type(kept.large_type);
  actions_->hide_interface->setChecked(kept.panels_hidden);
}

void MainWindow::show_case(QMdiSubWindow& child, const engine::LoadedStudy& study,
                           const engine::RestoredCase& restored) {
  centre_->setCurrentWidget(area_);
  area_->show_child(child);
  auto& window = static_cast<CaseWindow&>(*child.widget());
  if (restored.contents) {
    panels_->show("level-set");  // it has begun: to be steered
    const Status shown = window.restore_view(*restored.contents);
    if (!shown) tell(tr("How it was shown is lost: %1").arg(engine::message_text(shown.error())));
  }
  const auto results = opener_->results_beside(study);
  if (study.volume->changes.empty() && results.empty()) return;
  auto* report = new LoadReport(study, results);
  messages_->show_widget(report);
  messages_->mark_as_of(window);
  connect(report, &LoadReport::dismissed, messages_, &MessageBar::dismiss);
  connect(report, &LoadReport::import_wanted, &window, [this, &window](const QStringList& files) {
    for (const QString& file : files) results_->import_labels(window, file);
  });
}

void MainWindow::tell(const QString& message, const QString& about) {
  messages_->show_text(message, about);
}

void MainWindow::tell(CaseWindow& of, const QString& message, const QString& about) {
  tell(message, about);
  messages_->mark_as_of(of);
}

void MainWindow::dismiss_about(const QString& about) {
  messages_->dismiss_about(about);
}

// The active case.

CaseWindow* MainWindow::active_case() const {
  return active_;
}

void MainWindow::bring_to_front(CaseWindow& window) {
  auto* child = static_cast<QMdiSubWindow*>(window.parentWidget());
  if (!child->isVisible()) return;
  if (child->isMinimized()) child->showNormal();
  area_->setActiveSubWindow(child);
}

QList<CaseWindow*> MainWindow::cases() const {
  return area_->cases();
}

CaseWindow* MainWindow::case_of_session(const QString& file) const {
  const QList<CaseWindow*> all = cases();
  const auto found = std::find_if(all.begin(), all.end(), [&](const CaseWindow* window) {
    const auto is_it = [&](const QString& one) { return is_same_place(one, file); };
    const QStringList& coming = window->files_being_saved;
    return is_it(window->session_file) || std::any_of(coming.begin(), coming.end(), is_it);
  });
  return found == all.end() ? nullptr : *found;
}

int MainWindow::free_number() const {
  QSet<int> taken;
  for (CaseWindow* window : cases()) taken << window->number();
  int number = 1;
  while (taken.contains(number)) ++number;
  return number;
}

void MainWindow::activate(QMdiSubWindow* child) {
  // While dialogs and docks have the focus no child is active, but the case still is.
  if (!child && !area_->subWindowList().isEmpty()) return;
  for (const auto& connection : std::exchange(active_connections_, {})) disconnect(connection);
  active_ = child ? qobject_cast<CaseWindow*>(child->widget()) : nullptr;
  opener_->set_previews_wanted(!active_);
  if (!active_) {
    centre_->setCurrentIndex(0);
    messages_->dismiss();  // it was about a closed case
    quit_at_last();
  }
  engine::CaseProxy* proxy = active_ ? &active_->proxy() : nullptr;
  panels_->set_case(active_);
  status_bar_->set_proxy(proxy);
  if (proxy) {
    active_connections_ << connect(proxy, &engine::CaseProxy::state_changed, this, &MainWindow::follow_case)
                        << connect(&proxy->display(), &engine::Display::changed, this,
                                   &MainWindow::follow_case);
  }
  follow_case();
}

void MainWindow::follow_case() {
  actions_->follow(active_ ? &active_->proxy() : nullptr);
  actions_->link->setChecked(active_ && active_->linked());
  actions_->lock_step->setChecked(active_ && active_->proxy().in_lock_step() &&
                                  links_->any_in_lock_step(cases()));
  cohort_->follow_case();
}

void MainWindow::connect_views() {
  connect(actions_->hide_interface, &QAction::toggled, panels_, &PanelDocks::set_hidden);
  connect(actions_->full_screen, &QAction::triggered, this, [this](bool full) {
    // A window that was maximised is so again afterwards.
    setWindowState(windowState().setFlag(Qt::WindowFullScreen, full));
  });
  connect(actions_->themes, &QActionGroup::triggered, this, [](QAction* chosen) {
    const auto theme = static_cast<Theme>(chosen->data().toInt());
    settings::theme().set(theme);
    apply_theme(*qApp, theme);
  });
  const int theme = static_cast<int>(settings::theme().get());
  for (QAction* action : actions_->themes->actions()) action->setChecked(action->data().toInt() == theme);
}

void MainWindow::connect_windows() {
  connect(actions_->tile, &QAction::triggered, this, [this] {
    actions_->tabs->setChecked(false);
    area_->tile();
  });
  connect(actions_->cascade, &QAction::triggered, this, [this] {
    actions_->tabs->setChecked(false);
    area_->cascade();
  });
  connect(actions_->tabs, &QAction::toggled, area_, &CaseArea::set_tabs);
  connect(actions_->link, &QAction::triggered, this,
          [this](bool linked) { links_->link(linked ? cases() : QList<CaseWindow*>{}); });
  connect(links_, &CaseLinks::changed, this, &MainWindow::follow_case);
  connect(actions_->lock_step, &QAction::triggered, this,
          [this](bool together) { links_->play_together(cases(), together); });
}

// One case alone is in no lock-step.
void MainWindow::follow_closing() {
  if (!links_->any_in_lock_step(cases())) links_->play_together(cases(), false);
}

void MainWindow::connect_help() {
  help_ = new Help(*this);
  connect(actions_->keys, &QAction::triggered, this, [this] { KeysDialog(*actions_, this).exec(); });
  connect(actions_->first_steps, &QAction::triggered, this, [this] { show_first_steps(this, *actions_); });
  connect(actions_->about, &QAction::triggered, this, [this] { AboutDialog(this).exec(); });
}

// The window itself.

void MainWindow::closeEvent(QCloseEvent* event) {
  if (!may_give_up_work(*this) || !cohort_->may_close() || !teaching_->may_close()) return event->ignore();
  if (!close_cases()) return event->ignore();
  if (files_->writing() || films_->writing()) {
    quitting_ = true;
    tell(tr("Tidemark closes once all files are written."));
    return event->ignore();
  }
  keep_arrangement();
  event->accept();
}

// Those without changes close last: a case that the user keeps open keeps what is left open, too. Where cases
// close once they are saved, closing is tried again after that. While one asks, others may go.
bool MainWindow::close_cases() {
  quitting_ = false;
  QList<QPointer<CaseWindow>> all;
  for (CaseWindow* window : cases()) all << window;
  std::stable_partition(all.begin(), all.end(),
                        [](const QPointer<CaseWindow>& window) { return window->proxy().state().modified; });
  const auto closes_later = [this](const CaseWindow* window) {
    return session_writer_->closes_later(*window);
  };
  for (const QPointer<CaseWindow>& window : all) {
    if (!window || closes_later(window)) continue;
    if (!window->parentWidget()->close() && window && !closes_later(window)) return false;
  }
  const QList<CaseWindow*> left = cases();
  quitting_ = !left.isEmpty() && std::all_of(left.begin(), left.end(), closes_later);
  return left.isEmpty();
}

// Once nothing is left that it waits for.
void MainWindow::quit_at_last() {
  if (cases().isEmpty() && std::exchange(quitting_, false))
    QMetaObject::invokeMethod(this, &QWidget::close, Qt::QueuedConnection);
}

void MainWindow::keep_arrangement() const {
  settings::window_state().set(panels_->arrangement());
  settings::window_geometry().set(saveGeometry());
}

// The arrangement of the last time and the window system, too, choose full screen.
void MainWindow::changeEvent(QEvent* event) {
  QMainWindow::changeEvent(event);
  if (event->type() == QEvent::WindowStateChange) actions_->full_screen->setChecked(isFullScreen());
}

bool MainWindow::focusNextPrevChild(bool next) {
  const QWidget* from = focusWidget() ? focusWidget() : this;
  const auto allowed = [this](const QWidget& widget) {
    return !area_->viewport()->isAncestorOf(&widget) || (active_ && active_->isAncestorOf(&widget));
  };
  QWidget* to = next_in_focus_chain(*from, next, allowed);
  if (to) to->setFocus(next ? Qt::TabFocusReason : Qt::BacktabFocusReason);
  return to != nullptr;
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (!dropped_paths(*event->mimeData()).isEmpty()) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  const QPoint place = event->position().toPoint();
  results_->take_dropped(dropped_paths(*event->mimeData()), area_->case_of(childAt(place)));
  event->acceptProposedAction();
}

}  // namespace tidemark::ui
