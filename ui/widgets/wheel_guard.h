// A guard against the wheel: it scrolls a panel, and does not change what the pointer happens to pass over.
#pragma once

class QWidget;

namespace tidemark::ui {

// The widget takes the wheel only while it has the focus, and does not get the focus from the wheel.
void guard_wheel(QWidget* widget);

}  // namespace tidemark::ui
