// Cases that are looked at together: what moves in one moves in all.
#pragma once

#include <QObject>
#include <QPointer>

#include "ui/main/case_window.h"

namespace tidemark {

class CaseLinks : public QObject {
  Q_OBJECT
 public:
  using QObject::QObject;

  void add(CaseWindow& window);
  // Cursor, slices, window and level, camera and clip plane. Positions are the patient's: cases of one patient
  // show the same place whatever their grids.
  void set_linked(bool linked);
  [[nodiscard]] bool linked() const { return linked_; }

 private:
  void follow(CaseWindow& moved);

  QList<QPointer<CaseWindow>> windows_;
  bool linked_ = false;
  bool following_ = false;
};

}  // namespace tidemark
