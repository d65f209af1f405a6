// The scroll area of panels that are lower than their content.
#pragma once

#include <QScrollArea>

namespace tidemark::ui {

// Scrolls up and down only: it asks for as much width as its content needs, whenever that changes.
class PanelScroll : public QScrollArea {
  Q_OBJECT
 public:
  explicit PanelScroll(QWidget* content, QWidget* parent = nullptr);

  [[nodiscard]] QSize minimumSizeHint() const override;
  [[nodiscard]] QSize sizeHint() const override;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
};

// A wheel that scrolls the panel must not change the number or the choice that passes below the pointer: it
// acts on the control only when that has the focus.
void guard_from_wheel(QWidget* control);

}  // namespace tidemark::ui
