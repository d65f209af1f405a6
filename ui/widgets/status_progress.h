// The progress of work in the status bar: what is done, a bar, and Cancel. Not modal.
#pragma once

#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QStatusBar>

#include "engine/result_jobs.h"

namespace tidemark::ui {

class StatusProgress : public QWidget {
  Q_OBJECT
 public:
  // At the end of that bar. Hidden until work begins, and whoever began it hides it at the end.
  explicit StatusProgress(QStatusBar& bar);

  // Shows how far those are. Cancel cancels them.
  void follow(engine::ResultJobs& jobs);

 public slots:
  void begin(const QString& sentence);  // "Opening head_t1"
  // As engine::JobRunner::progressed() says it.
  void set_progress(double fraction, const QString& step);

 signals:
  void cancelled();

 protected:
  void keyPressEvent(QKeyEvent* event) override;

 private:
  QLabel* what_;
  QLabel* step_;
  QProgressBar* bar_;
};

}  // namespace tidemark::ui
