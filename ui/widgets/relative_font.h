// Texts larger than the others, whatever size these have.
#pragma once

#include <QFont>

class QWidget;

namespace tidemark::ui {

// The application's font, `size` times as large; also after that has changed and the style sheet was set
// anew.
void set_relative_font(QWidget& widget, double size, QFont::Weight weight = QFont::Normal);

}  // namespace tidemark::ui
