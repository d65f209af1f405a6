// Scrolling, as a hand does before it clicks.
#pragma once

#include <QScrollArea>

namespace tidemark::test {

// Scrolls each area around the widget to it.
inline void bring_into_sight(QWidget& widget) {
  for (QWidget* outer = widget.parentWidget(); outer != nullptr; outer = outer->parentWidget()) {
    if (auto* scroll = qobject_cast<QScrollArea*>(outer)) scroll->ensureWidgetVisible(&widget);
  }
}

}  // namespace tidemark::test
