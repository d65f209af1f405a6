// The hint at the next step, in the middle of a 3D view: place a surface, then play.
#pragma once

#include <QAbstractButton>
#include <QWidget>

#include "engine/case_proxy.h"

class QLabel;

namespace tidemark::ui {

// Round and large, for what is to be pressed next. Enter and Space press it.
class PlayButton : public QAbstractButton {
  Q_OBJECT
 public:
  explicit PlayButton(QWidget* parent = nullptr);
  [[nodiscard]] QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  bool event(QEvent* event) override;
};

// A child of the view. It goes when the surface moves for the first time; it is not there while the study
// itself or a clip plane is looked at.
class NextStep : public QWidget {
  Q_OBJECT
 public:
  NextStep(engine::CaseProxy& proxy, QWidget& view);

 signals:
  void place_wanted();  // the tool and the panel that place a surface

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

 private:
  void follow();
  void move_into_view();

  engine::CaseProxy& proxy_;
  QWidget& view_;
  QWidget* hint_;
  QLabel* how_;
  PlayButton* play_;
};

}  // namespace tidemark::ui
