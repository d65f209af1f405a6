// The icon of a case that fills the window, at the left of the menu bar.
#pragma once

class QMenuBar;

namespace tidemark::ui {

// Qt puts it there, but on dense screens it draws it too large for its place. From now on it is drawn whole.
void draw_menu_bar_icon_whole(QMenuBar& bar);

}  // namespace tidemark::ui
