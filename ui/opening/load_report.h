// What was found and changed when a study was loaded. Not modal; goes when it is dismissed.
#pragma once

#include <QFrame>

#include "session/study_loader.h"

namespace tidemark {

class LoadReport : public QFrame {
  Q_OBJECT
 public:
  explicit LoadReport(const LoadedStudy& study, QWidget* parent = nullptr);

 signals:
  void dismissed();

 protected:
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void dismiss();
};

}  // namespace tidemark
