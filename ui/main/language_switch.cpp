#include "ui/main/language_switch.h"

#include <QApplication>
#include <QDialog>
#include <QTimer>
#include <algorithm>
#include <utility>

#include "engine/background_job.h"
#include "ui/look/language.h"
#include "ui/main/main_window.h"
#include "ui/main/teaching.h"
#include "ui/settings.h"
#include "ui/widgets/status_progress.h"
#include "ui/widgets/work_line.h"

namespace tidemark::ui {
namespace {

// Something is being read, written or measured, which its line shows, or a dialog waits for its user: this
// would end with the window.
bool is_at_work(const MainWindow& window) {
  const auto progress = window.findChildren<StatusProgress*>();
  const auto work = window.findChildren<WorkLine*>();
  const auto dialogs = window.findChildren<QDialog*>();
  return std::any_of(progress.begin(), progress.end(), [](const auto* line) { return line->isVisible(); }) ||
         std::any_of(work.begin(), work.end(), [](const auto* line) { return line->working(); }) ||
         std::any_of(dialogs.begin(), dialogs.end(), [](const auto* dialog) { return dialog->isVisible(); });
}

// Nothing is on its way that an answer would follow.
bool is_quiet(const MainWindow& window) {
  const QList<CaseWindow*> all = window.cases();
  return !QApplication::activeModalWidget() && !QApplication::activePopupWidget() &&
         !engine::BackgroundJob::any_running() &&
         std::none_of(all.begin(), all.end(), [](CaseWindow* one) { return one->proxy().is_asked(); });
}

}  // namespace

LanguageSwitch::LanguageSwitch(engine::Engine& engine) : engine_(engine) {
  make_window();
  window_->show();
}

LanguageSwitch::~LanguageSwitch() = default;

void LanguageSwitch::make_window() {
  use_language(settings::language().get());
  window_ = std::make_unique<MainWindow>(engine_);
  connect(window_->actions().languages, &QActionGroup::triggered, this,
          [this](const QAction* language) { choose(*language); });
}

void LanguageSwitch::choose(const QAction& language) {
  const bool waits = std::exchange(wanted_, language.data().toString()).has_value();
  patience_.setRemainingTime(kPatienceMs);
  if (!waits) look(false);
}

// The menu whose entry it was is still at work, and perhaps a copy against a crash is: both end soon. Who
// does not see the change by then goes on with other work, which must not end with the window. Answers that
// were posted before it is quiet arrive before it is so a second time.
void LanguageSwitch::look(bool was_quiet) {
  if (wanted_ == settings::language().get()) return wanted_.reset();
  if (is_at_work(*window_) || patience_.hasExpired()) return refuse();
  const bool quiet = is_quiet(*window_);
  if (quiet && was_quiet) return change();
  QTimer::singleShot(kLookAgainMs, this, [this, quiet] { look(quiet); });
}

void LanguageSwitch::refuse() {
  wanted_.reset();
  for (QAction* action : window_->actions().languages->actions())
    action->setChecked(action->data().toString() == settings::language().get());
  window_->tell(MainWindow::tr(
      "The language can be changed once dialogs are closed and nothing is being read or written."));
}

void LanguageSwitch::change() {
  settings::language().set(*std::exchange(wanted_, std::nullopt));
  MainWindow::Kept kept = window_->keep();
  // Between two windows there is none, which is no reason to end.
  const bool ends = QGuiApplication::quitOnLastWindowClosed();
  QGuiApplication::setQuitOnLastWindowClosed(false);
  window_.reset();
  make_window();
  window_->show();
  window_->take_over(std::move(kept));
  QGuiApplication::setQuitOnLastWindowClosed(ends);
}

}  // namespace tidemark::ui
