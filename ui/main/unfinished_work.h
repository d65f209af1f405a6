// Work of dialogs that ends with the window.
#pragma once

class QWidget;

namespace tidemark::ui {

// Whether the window may close. Where dialogs are at work it asks, and gives up what the user agrees to.
[[nodiscard]] bool may_give_up_work(QWidget& window);

}  // namespace tidemark::ui
