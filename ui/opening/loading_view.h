// The progress of loading a study: its name, a bar, and Cancel. Not modal.
#pragma once

#include <QFrame>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>

namespace tidemark::ui {

class LoadingView : public QFrame {
  Q_OBJECT
 public:
  enum class Shape {
    card,  // in a window of its own, or inside another
    line,  // in a status bar
  };
  explicit LoadingView(Shape shape, QWidget* parent = nullptr);

 public slots:
  void begin(const QString& what);  // "head_t1"
  // As StudyLoader::progressed() says it.
  void set_progress(double fraction, const QString& step);
  // Stays to be read until it is closed.
  void fail(const QString& message);

 signals:
  void cancelled();
  void closed();  // after a failure was read

 protected:
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void press();

  bool failed_ = false;
  QLabel* what_;
  QLabel* step_;
  QProgressBar* bar_;
  QPushButton* button_;
};

}  // namespace tidemark::ui
