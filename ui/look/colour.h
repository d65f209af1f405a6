// Colours between others.
#pragma once

#include <QColor>

namespace tidemark::ui {

// `share` 0: `from`; 1: `to`. Opacities are mixed, too.
QColor mixed(const QColor& from, const QColor& to, double share);

}  // namespace tidemark::ui
