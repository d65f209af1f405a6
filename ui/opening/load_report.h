// What was found and changed when a study was loaded: a line, and all of it below when it is asked for. Not
// modal; goes when it is dismissed.
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
