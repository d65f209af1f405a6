#include "ui/views/colour_scale.h"

#include <QCoreApplication>
#include <QLinearGradient>
#include <algorithm>

#include "document/sweep_picture.h"
#include "ui/views/overlay.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {
namespace {

constexpr double kLongestScale = 170.0;
constexpr double kHeight = 8.0;
constexpr double kLine = 18.0;
constexpr double kScaleMargin = 8.0;
constexpr double kScaleBar = 34.0;  // which lies below
const QList<QColor> kDiverging{QColor(33, 92, 171), QColor(242, 242, 242), QColor(204, 102, 13)};

QString text(const char* source) {
  return QCoreApplication::translate("View", source);
}

}  // namespace

ColourScale scale_of_doubt() {
  return {{QColor(77, 13, 107), QColor(255, 204, 242)},
          text(QT_TRANSLATE_NOOP("View", "Doubt")),
          text(QT_TRANSLATE_NOOP("View", "sure")),
          text(QT_TRANSLATE_NOOP("View", "undecided"))};
}

ColourScale scale_of_truth_error(double range_mm) {
  const QString far = general_text(range_mm, 3);
  return {kDiverging, text(QT_TRANSLATE_NOOP("View", "From the truth")),
          QCoreApplication::translate("View", "−%1 mm too little").arg(far),
          QCoreApplication::translate("View", "too much +%1 mm").arg(far)};
}

ColourScale scale_of_change(double within_mm) {
  const QString far = general_text(within_mm, 3);
  return {kDiverging, text(QT_TRANSLATE_NOOP("View", "Change")),
          QCoreApplication::translate("View", "−%1 mm removed").arg(far),
          QCoreApplication::translate("View", "added +%1 mm").arg(far)};
}

ColourScale scale_of_spread(double range_mm) {
  return {kDiverging, text(QT_TRANSLATE_NOOP("View", "Surfaces of the runs")),
          text(QT_TRANSLATE_NOOP("View", "together")),
          QCoreApplication::translate("View", "%1 mm apart or more").arg(general_text(range_mm, 3))};
}

ColourScale scale_of_agreement(double runs) {
  const auto colour_at = [](double share) {
    const auto [red, green, blue] = document::heat_colour(share);
    return QColor(red, green, blue);
  };
  QList<QColor> colours;
  constexpr int kSteps = 20;
  // From the share of one run to that of all.
  for (int i = 0; i <= kSteps; ++i) colours << colour_at((1.0 + (runs - 1.0) * i / kSteps) / runs);
  return {colours, text(QT_TRANSLATE_NOOP("View", "Inside in so many runs")), QStringLiteral("1"),
          number_text(runs, 0)};
}

void paint_colour_scale(QPainter& painter, QSizeF size, const ColourScale& scale) {
  const QFontMetricsF metrics(painter.font());
  const double wide = metrics.horizontalAdvance(scale.low + scale.high) + 20.0;
  const double length = std::min(std::max(kLongestScale, wide), size.width() - 2.0 * kScaleMargin);
  const double left = size.width() - kScaleMargin - length;
  const double below = size.height() - kScaleMargin - kScaleBar;
  const QRectF bar(left, below - kLine - kHeight, length, kHeight);
  QLinearGradient gradient(bar.topLeft(), bar.topRight());
  for (qsizetype i = 0; i < scale.colours.size(); ++i)
    gradient.setColorAt(static_cast<double>(i) / static_cast<double>(scale.colours.size() - 1),
                        scale.colours[i]);
  painter.save();
  painter.setPen(QPen(QColor(0, 0, 0, 180), 1.0));
  painter.setBrush(gradient);
  painter.drawRect(bar);
  painter.restore();
  const QRectF under(left, below - kLine, length, kLine);
  paint_text(painter, under, Qt::AlignLeft | Qt::AlignVCenter, scale.low);
  paint_text(painter, under, Qt::AlignRight | Qt::AlignVCenter, scale.high);
  paint_text(painter, bar.translated(0.0, -kLine - 1.0).adjusted(0.0, 0.0, 0.0, kLine - kHeight),
             Qt::AlignRight | Qt::AlignBottom, scale.title);
}

}  // namespace tidemark::ui
