// A button that shows a colour and lets another be chosen.
#pragma once

#include <QColor>
#include <QToolButton>

namespace tidemark::ui {

class ColourButton : public QToolButton {
  Q_OBJECT
 public:
  explicit ColourButton(QWidget* parent = nullptr);

  void set_colour(const QColor& colour);  // without a signal
  [[nodiscard]] const QColor& colour() const { return colour_; }

 signals:
  void chosen(const QColor& colour);

 private:
  void choose();
  QColor colour_ = Qt::yellow;
};

// A filled square with an edge that shows on any background.
QPixmap colour_swatch(const QColor& colour, QSize size, const QWidget& on);

}  // namespace tidemark::ui
