#include "ui/transfer/panel_scroll.h"

#include <QEvent>
#include <QScrollBar>
#include <QWidget>

namespace tidemark::ui {
namespace {

class WheelGuard : public QObject {
 public:
  using QObject::QObject;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() != QEvent::Wheel || static_cast<QWidget*>(watched)->hasFocus()) return false;
    event->ignore();
    return true;
  }
};

}  // namespace

PanelScroll::PanelScroll(QWidget* content, QWidget* parent) : QScrollArea(parent) {
  setWidget(content);  // tells eventFilter() of its events
  setWidgetResizable(true);
  setFrameShape(QFrame::NoFrame);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
}

QSize PanelScroll::minimumSizeHint() const {
  constexpr int kLowest = 160;
  return {widget()->minimumSizeHint().width() + verticalScrollBar()->sizeHint().width(), kLowest};
}

QSize PanelScroll::sizeHint() const {
  return widget()->sizeHint().expandedTo(minimumSizeHint());
}

bool PanelScroll::eventFilter(QObject* watched, QEvent* event) {
  if (watched == widget() && event->type() == QEvent::LayoutRequest) updateGeometry();
  return QScrollArea::eventFilter(watched, event);
}

void guard_from_wheel(QWidget* control) {
  // Else the wheel itself would give it the focus.
  control->setFocusPolicy(Qt::StrongFocus);
  control->installEventFilter(new WheelGuard(control));
}

}  // namespace tidemark::ui
