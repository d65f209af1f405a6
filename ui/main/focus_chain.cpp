#include "ui/main/focus_chain.h"

#include <QWidget>

namespace tidemark::ui {
namespace {

bool can_be_reached(const QWidget& widget) {
  return (widget.focusPolicy() & Qt::TabFocus) == Qt::TabFocus && widget.focusProxy() == nullptr &&
         widget.isVisible() && widget.isEnabled();
}

}  // namespace

QWidget* next_in_focus_chain(const QWidget& from, bool forward,
                             const std::function<bool(const QWidget&)>& allowed) {
  const auto next = [forward](const QWidget* widget) {
    return forward ? widget->nextInFocusChain() : widget->previousInFocusChain();
  };
  for (QWidget* widget = next(&from); widget && widget != &from; widget = next(widget)) {
    if (widget->window() == from.window() && can_be_reached(*widget) && allowed(*widget)) return widget;
  }
  return nullptr;
}

}  // namespace tidemark::ui
