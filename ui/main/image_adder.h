// Further images of an open case: another series of its study, or any file.
#pragma once

#include <QObject>

#include "ui/main/case_window.h"
#include "ui/panels/per_case.h"

namespace tidemark::ui {

class MainWindow;

class ImageAdder : public QObject {
  Q_OBJECT
 public:
  explicit ImageAdder(MainWindow& window);

  void ask_for_file(CaseWindow& into);
  // Chosen from the folder or archive that the case came from.
  void ask_for_series(CaseWindow& into);
  void add_file(CaseWindow& into, const QString& path);

 private:
  class OfCase;
  OfCase& of(CaseWindow& into);

  MainWindow& window_;
  PerCase<OfCase*> of_cases_;  // of those that were given images; children of them
};

}  // namespace tidemark::ui
