#include "ui/widgets/colour_button.h"

#include <QColorDialog>
#include <QPainter>

#include "ui/look/theme.h"

namespace tidemark::ui {

QPixmap colour_swatch(const QColor& colour, QSize size, const QWidget& on) {
  const double scale = on.devicePixelRatioF();
  QPixmap picture(size * scale);
  picture.setDevicePixelRatio(scale);
  picture.fill(colour);
  QPainter painter(&picture);
  painter.setPen(on.palette().color(QPalette::WindowText));
  painter.drawRect(QRectF(QPointF(0.5, 0.5), QSizeF(size) - QSizeF(1.0, 1.0)));
  return picture;
}

ColourButton::ColourButton(QWidget* parent) : QToolButton(parent) {
  setIconSize({2 * kIcon, kIconSmall});
  connect(this, &QToolButton::clicked, this, &ColourButton::choose);
  set_colour(colour_);
}

void ColourButton::set_colour(const QColor& colour) {
  colour_ = colour;
  setIcon(colour_swatch(colour, iconSize(), *this));
  setAccessibleDescription(colour.name());
}

void ColourButton::choose() {
  auto* dialog = new QColorDialog(colour_, this);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  connect(dialog, &QColorDialog::colorSelected, this, [this](const QColor& colour) {
    set_colour(colour);
    emit chosen(colour);
  });
  dialog->open();
}

}  // namespace tidemark::ui
