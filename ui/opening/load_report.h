// The report of loading a study: one line of what was found and changed, and all of it on demand. Not modal;
// the user dismisses it.
#pragma once

#include <QFrame>

#include "engine/study_loader.h"

class QPushButton;

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
  QWidget* make_line(const LoadedStudy& study);
  QWidget* make_details(const std::vector<std::string>& changes);
  void dismiss();

  QPushButton* details_button_;
};

}  // namespace tidemark
