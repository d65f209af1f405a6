// The style: Fusion without its few drawings that ignore the palette and are lost in the dark theme.
#pragma once

#include <QProxyStyle>

namespace tidemark::ui {

class Style : public QProxyStyle {
  Q_OBJECT
 public:
  Style();

  // Buttons in the titles of docks: our icons.
  // Room for the arrow of a tool bar that is too narrow for its tools.
  int pixelMetric(PixelMetric which, const QStyleOption* option = nullptr,
                  const QWidget* widget = nullptr) const override;
  QIcon standardIcon(StandardPixmap which, const QStyleOption* option = nullptr,
                     const QWidget* widget = nullptr) const override;
  // Names of panels are written out beside them; where they have no room, one scrolls.
  void polish(QWidget* widget) override;
  using QProxyStyle::polish;
  // The cross of tabs, and the outlines of check boxes.
  void drawPrimitive(PrimitiveElement element, const QStyleOption* option, QPainter* painter,
                     const QWidget* widget = nullptr) const override;
  // Titles of windows inside the main window.
  void drawComplexControl(ComplexControl control, const QStyleOptionComplex* option, QPainter* painter,
                          const QWidget* widget = nullptr) const override;
};

}  // namespace tidemark::ui
