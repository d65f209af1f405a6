// A line about a piece of work: its progress, a way to give it up, and its end.
#pragma once

#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QWidget>

namespace tidemark::ui {

class WorkLine : public QWidget {
  Q_OBJECT
 public:
  explicit WorkLine(QWidget* parent = nullptr);

  void begin(const QString& what);
  void set_progress(double fraction, const QString& step);  // below 0 when unknown
  void end(const QString& said);                            // stays to be read
  [[nodiscard]] bool working() const { return !bar_->isHidden(); }
  [[nodiscard]] QString text() const { return said_->text(); }

 signals:
  void cancelled();

 private:
  QLabel* said_;
  QProgressBar* bar_;
  QPushButton* cancel_;
};

}  // namespace tidemark::ui
