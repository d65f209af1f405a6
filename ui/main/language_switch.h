// The main window in the language that the user wants.
#pragma once

#include <QObject>
#include <memory>

#include "engine/engine.h"

class QAction;

namespace tidemark::ui {

class MainWindow;

// Texts are made with their widgets. Where the language changes, the window goes, and another one around the
// same cases comes.
class LanguageSwitch : public QObject {
  Q_OBJECT
 public:
  // Shows the window, in the language of the settings.
  explicit LanguageSwitch(engine::Engine& engine);
  ~LanguageSwitch() override;

  [[nodiscard]] MainWindow& window() { return *window_; }

 private:
  static constexpr int kLookAgainMs = 20;
  void make_window();
  void choose(const QAction& language);
  void wait();
  void look(bool was_quiet);
  void change();

  engine::Engine& engine_;
  std::unique_ptr<MainWindow> window_;
  bool waiting_ = false;  // for a moment at which nothing would be lost
};

}  // namespace tidemark::ui
