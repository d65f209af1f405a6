// The next widget for the keyboard, where Qt's own choice would not do.
#pragma once

#include <functional>

class QWidget;

namespace tidemark::ui {

// The first widget behind `from` in its window's focus chain (before it, when not `forward`) that Tab can
// reach and for which `allowed` is true; null: there is none.
[[nodiscard]] QWidget* next_in_focus_chain(const QWidget& from, bool forward,
                                           const std::function<bool(const QWidget&)>& allowed);

}  // namespace tidemark::ui
