#include "ui/transfer/panel_scroll.h"

#include <QEvent>
#include <QScrollBar>
#include <QWidget>

namespace tidemark::ui {

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

}  // namespace tidemark::ui
