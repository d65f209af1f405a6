// A case beside a copy of it, to see what a parameter does.
#pragma once

#include <QObject>
#include <functional>

#include "ui/main/case_window.h"

namespace tidemark::ui {

class CaseLinks;
class MainWindow;

class CaseComparison : public QObject {
  Q_OBJECT
 public:
  CaseComparison(MainWindow& window, CaseLinks& links);

  // Opens a case that is like this one now, with its history, and goes on by itself. It is in no file. `done`
  // gets it, unless the case was closed meanwhile.
  void duplicate(CaseWindow& original, std::function<void(CaseWindow&)> done = {});
  // The case and a copy with the other scheme (paper, split) side by side, linked, playing in lock-step.
  void compare_schemes(CaseWindow& original);

 private:
  MainWindow& window_;
  CaseLinks& links_;
};

}  // namespace tidemark::ui
