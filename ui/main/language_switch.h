// The main window in the language that the user wants.
#pragma once

#include <QDeadlineTimer>
#include <QObject>
#include <QString>
#include <memory>
#include <optional>

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
  static constexpr int kPatienceMs = 5000;
  void make_window();
  void choose(const QAction& language);
  void look(bool was_quiet);
  void refuse();
  void change();

  engine::Engine& engine_;
  std::unique_ptr<MainWindow> window_;
  std::optional<QString> wanted_;  // as soon as nothing would be lost
  QDeadlineTimer patience_;
};

}  // namespace tidemark::ui
