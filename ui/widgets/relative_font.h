// Fonts that follow the one of the application when that changes, as for a projector.
#pragma once

#include <QFont>

class QDockWidget;
class QWidget;

namespace tidemark::ui {

// The application's font, `size` times as large; also after that has changed and the style sheet was set
// anew.
void set_relative_font(QWidget& widget, double size, QFont::Weight weight = QFont::Normal);

// Its title has the application's font, also after that has changed.
void let_title_follow_font(QDockWidget& dock);

}  // namespace tidemark::ui
