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

}  // namespace tidemark::ui
