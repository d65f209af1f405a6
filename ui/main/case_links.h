// Links between cases: a move in one is a move in all.
#pragma once

#include <QList>
#include <QObject>

#include "ui/main/case_window.h"

namespace tidemark::ui {

class CaseLinks : public QObject {
  Q_OBJECT
 public:
  using QObject::QObject;

  // Links these cases instead of those that were linked, if there are two at least; the first one leads. They
  // share cursor, slices, camera and clip plane, and within a modality window and level. Positions are the
  // patient's: cases of one patient show the same place whatever their grids. A case that is closed leaves,
  // and the last one is free.
  void link(const QList<CaseWindow*>& windows);
  void unlink() { link({}); }

  // Whether they play and step together, of which one alone has no use.
  void play_together(const QList<CaseWindow*>& windows, bool together);
  static bool any_in_lock_step(const QList<CaseWindow*>& windows);  // two at least

 signals:
  void changed();

 private:
  void follow(CaseWindow& moved);
  void show_differences();
  void forget(CaseWindow* closed);

  QList<CaseWindow*> windows_;  // those that are open
  bool following_ = false;
};

}  // namespace tidemark::ui
