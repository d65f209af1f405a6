#include "ui/transfer/preset_thumbnail.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include "ui/transfer/axis_primitive.h"
#include "ui/transfer/plot_painting.h"
#include "ui/transfer/primitive_handles.h"

namespace tidemark::ui {
namespace {

struct Shade {
  double opacity = 0.0;
  QColor colour;
};

// As the shaders mix: colours by opacity. Other factors than that of the axis are taken as 1.
Shade shade_at(const std::vector<AxisPrimitive>& primitives, std::size_t axis, double at) {
  glm::vec3 colour{0.0F};
  double sum = 0.0;
  for (const AxisPrimitive& primitive : primitives) {
    const double opacity = primitive.opacity * primitive.factors[axis].at(at);
    colour += static_cast<float>(opacity) * primitive.colour;
    sum += opacity;
  }
  if (sum > 0.0) colour /= static_cast<float>(sum);
  return {sum, to_qcolor(glm::min(colour, glm::vec3(1.0F)))};
}

void paint_histogram(QPainter& painter, const QRectF& area, const Extent& shown,
                     const engine::SourceSummary& summary, const QColor& colour) {
  if (summary.values.empty() || !(summary.highest > summary.lowest)) return;
  const auto most = static_cast<double>(*std::max_element(summary.values.begin(), summary.values.end()));
  for (double x = area.left(); x < area.right(); x += 1.0) {
    const double value = shown.low + (x - area.left() + 0.5) / area.width() * (shown.high - shown.low);
    const double share = (value - summary.lowest) / (summary.highest - summary.lowest);
    if (share < 0.0 || share >= 1.0) continue;
    const auto count = summary.values[static_cast<std::size_t>(share * engine::SourceSummary::kBins)];
    const double height = area.height() * std::log1p(static_cast<double>(count)) / std::log1p(most);
    painter.fillRect(QRectF(x, area.bottom() - height, 1.0, height), colour);
  }
}

}  // namespace

QPixmap preset_thumbnail(const renderer::TransferFunction& function, const engine::SourceSummary& summary,
                         const QPalette& palette, double pixel_ratio) {
  QPixmap picture(kThumbnailSize * pixel_ratio);
  picture.setDevicePixelRatio(pixel_ratio);
  picture.fill(palette.color(QPalette::Base));
  QPainter painter(&picture);
  const QRectF area(QPointF(0.0, 0.0), QSizeF(kThumbnailSize));
  const bool of_source = !function.source.empty();
  const auto primitives = primitives_of(function, of_source ? PrimitiveKind::source : PrimitiveKind::surface);
  const std::size_t axis = of_source ? 0 : 1;
  Extent shown = of_source ? Extent{summary.low, summary.high} : Extent{0.0, 10.0};
  for (const AxisPrimitive& primitive : primitives) include(shown, primitive.factors[axis]);
  const QColor text = palette.color(QPalette::Text);
  if (of_source)
    paint_histogram(painter, area, shown, summary, mixed(palette.color(QPalette::Base), text, 0.18));
  double most = 1e-9;
  const auto at = [&](double x) {
    return shade_at(primitives, axis, shown.low + (x + 0.5) / area.width() * (shown.high - shown.low));
  };
  for (double x = 0.0; x < area.width(); x += 1.0) most = std::max(most, at(x).opacity);
  QPolygonF line;
  const double step = 1.0 / pixel_ratio;
  for (double x = 0.0; x < area.width(); x += step) {
    const Shade shade = at(x);
    const double height = (area.height() - 4.0) * std::cbrt(shade.opacity / most);
    painter.fillRect(QRectF(x, area.bottom() - height, step, height), shade.colour);
    line << QPointF(x + step / 2.0, area.bottom() - height);
  }
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(text, 1.0));
  painter.drawPolyline(line);
  painter.setPen(QPen(palette.color(QPalette::Mid), 1.0));
  painter.drawRect(area.adjusted(0.5, 0.5, -0.5, -0.5));
  return picture;
}

}  // namespace tidemark::ui
