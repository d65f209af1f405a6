// A part of a panel that is scrolled into sight.
#pragma once

#include <QScrollArea>

#include "ui/look/theme.h"

namespace tidemark::ui {

// In each scroll area around it.
inline void bring_into_sight(QWidget& part) {
  for (QWidget* above = part.parentWidget(); above; above = above->parentWidget()) {
    if (auto* scroll = qobject_cast<QScrollArea*>(above)) scroll->ensureWidgetVisible(&part, 0, kSpace);
  }
}

}  // namespace tidemark::ui
