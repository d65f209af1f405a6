#include "ui/main/language_switch.h"

#include <QGuiApplication>

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
  // The menu whose entry it was is still at work.
  connect(window_.get(), &MainWindow::language_changed, this, &LanguageSwitch::change, Qt::QueuedConnection);
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
