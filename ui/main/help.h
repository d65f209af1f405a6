// The handbook in the system's browser, at the page of what has the keyboard.
#pragma once

#include <QObject>
#include <QStringList>

namespace tidemark::ui {

class MainWindow;

class Help : public QObject {
  Q_OBJECT
 public:
  // Carries the action `handbook` out, also while a dialog keeps the main window from it.
  explicit Help(MainWindow& window);

  // Folders with pages, the first that has the page counts. At first: where the handbook is installed, and
  // where it is built.
  void look_in(const QStringList& folders) { folders_ = folders; }
  [[nodiscard]] bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void open();

  MainWindow& window_;
  QStringList folders_;
};

}  // namespace tidemark::ui
