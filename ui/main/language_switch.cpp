#include "ui/main/language_switch.h"

#include <QGuiApplication>
#include <QTimer>
#include <utility>

#include "ui/look/language.h"
#include "ui/main/main_window.h"
#include "ui/main/teaching.h"
#include "ui/settings.h"

namespace tidemark::ui {

LanguageSwitch::LanguageSwitch(engine::Engine& engine) : engine_(engine) {
  make_window();
  window_->show();
}

LanguageSwitch::~LanguageSwitch() = default;

void LanguageSwitch::make_window() {
  use_language(settings::language().get());
  window_ = std::make_unique<MainWindow>(engine_);
  connect(window_.get(), &MainWindow::language_changed, this, &LanguageSwitch::wait);
}

// The menu whose entry it was is still at work, and perhaps a copy against a crash is. Answers that were
// posted before it is quiet arrive before it is so a second time.
void LanguageSwitch::wait() {
  if (!std::exchange(waiting_, true)) QTimer::singleShot(kLookAgainMs, this, [this] { look(false); });
}

void LanguageSwitch::look(bool was_quiet) {
  const bool quiet = window_->is_quiet();
  if (!quiet || !was_quiet) return QTimer::singleShot(kLookAgainMs, this, [this, quiet] { look(quiet); });
  waiting_ = false;
  change();
}

void LanguageSwitch::change() {
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
