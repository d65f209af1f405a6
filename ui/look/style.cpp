#include "ui/look/style.h"

#include <QMainWindow>
#include <QPainter>
#include <QStyleOption>
#include <QTabBar>

#include "ui/look/icons.h"
#include "ui/look/theme.h"

namespace tidemark::ui {
namespace {

// Fusion's outline of check boxes is darker than their background, and lost in the dark.
void outline(const QStyleOption& option, bool is_round, QPainter& painter) {
  constexpr float kStrength = 0.45F;
  QColor colour = option.palette.color(QPalette::WindowText);
  colour.setAlphaF(kStrength);
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(colour);
  painter.setBrush(Qt::NoBrush);
  if (is_round) {
    const double radius = (option.rect.width() | 1) / 2.0 - 1.0;
    painter.drawEllipse(QPointF(option.rect.center() + QPoint(1, 1)), radius, radius);
  } else {
    painter.drawRect(QRectF(option.rect).adjusted(0.5, 0.5, -0.5, -0.5));
  }
  painter.restore();
}

}  // namespace

Style::Style() : QProxyStyle(QStringLiteral("Fusion")) {}

int Style::pixelMetric(PixelMetric which, const QStyleOption* option, const QWidget* widget) const {
  constexpr int kExtension = 22;  // of a tool bar, in pixels: 12 leave its arrow five
  return which == PM_ToolBarExtensionExtent ? kExtension : QProxyStyle::pixelMetric(which, option, widget);
}

QIcon Style::standardIcon(StandardPixmap which, const QStyleOption* option, const QWidget* widget) const {
  switch (which) {
    case SP_TitleBarCloseButton:
    case SP_DockWidgetCloseButton:
      return icon(u"close");
    case SP_TitleBarNormalButton:
    case SP_TitleBarMaxButton:
      return icon(u"maximise");
    case SP_ToolBarHorizontalExtensionButton:
    case SP_ToolBarVerticalExtensionButton:
      return icon(u"more");
    default:
      return QProxyStyle::standardIcon(which, option, widget);
  }
}

void Style::polish(QWidget* widget) {
  QProxyStyle::polish(widget);
  auto* tabs = qobject_cast<QTabBar*>(widget);
  if (tabs == nullptr || qobject_cast<QMainWindow*>(tabs->parentWidget()) == nullptr) return;
  tabs->setElideMode(Qt::ElideNone);
  tabs->setUsesScrollButtons(true);
}

void Style::drawPrimitive(PrimitiveElement element, const QStyleOption* option, QPainter* painter,
                          const QWidget* widget) const {
  if (element != PE_IndicatorTabClose) {
    QProxyStyle::drawPrimitive(element, option, painter, widget);
    const bool is_round = element == PE_IndicatorRadioButton;
    if ((is_round || element == PE_IndicatorCheckBox) && is_dark(option->palette))
      outline(*option, is_round, *painter);
    return;
  }
  if (option->state & State_MouseOver) painter->fillRect(option->rect, option->palette.midlight());
  QRect cross(0, 0, kIconSmall, kIconSmall);
  cross.moveCenter(option->rect.center());
  icon(u"close").paint(painter, cross);
}

void Style::drawComplexControl(ComplexControl control, const QStyleOptionComplex* option, QPainter* painter,
                               const QWidget* widget) const {
  const auto* title = qstyleoption_cast<const QStyleOptionTitleBar*>(option);
  const bool active = title != nullptr && (title->titleBarState & State_Active) != 0;
  if (control != CC_TitleBar || title == nullptr || active || !is_dark(option->palette)) {
    QProxyStyle::drawComplexControl(control, option, painter, widget);
    return;
  }
  // Fusion draws the buttons of inactive windows black. Those of active ones are white, so it draws
  // this one as active, in the colour of inactive ones.
  QStyleOptionTitleBar shown = *title;
  shown.titleBarState |= State_Active;
  shown.state |= State_Active;
  shown.palette.setColor(QPalette::Highlight, shown.palette.color(QPalette::Window));
  QProxyStyle::drawComplexControl(control, &shown, painter, widget);
}

}  // namespace tidemark::ui
