// Keys that the widget in focus has a use for, before the shortcuts of the window.
#pragma once

class QKeyEvent;
class QWidget;

namespace tidemark::ui {

// Space presses a button. Home goes to the first of a list, a table or a slider, instead of back to the
// start. What takes text claims its keys by itself.
[[nodiscard]] bool owns_key(const QWidget* in_focus, const QKeyEvent& key);

}  // namespace tidemark::ui
