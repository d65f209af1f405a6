// One line of plain text that ends with an ellipsis where there is no room for all of it.
#pragma once

#include <QLabel>

namespace tidemark::ui {

// text() is the whole text; where only a part fits, the tool tip has all of it.
class ElidedLabel : public QLabel {
 public:
  explicit ElidedLabel(const QString& text, QWidget* parent = nullptr);

 protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

 private:
  [[nodiscard]] QString shown_text() const;
};

}  // namespace tidemark::ui
