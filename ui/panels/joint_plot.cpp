#include "ui/panels/joint_plot.h"

#include <QImage>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "ui/look/colour.h"
#include "ui/look/theme.h"
#include "ui/panels/value_unit.h"
#include "ui/views/marks_overlay.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {
namespace {

using engine::JointHistogram;

constexpr double kPoint = 1.6;  // radius

// Null: there is none.
std::shared_ptr<const document::CaseImage> second_image(const document::Drive& drive) {
  const auto found =
      std::ranges::find_if(drive.images, [](const auto& image) { return image->volume != nullptr; });
  return found == drive.images.end() ? nullptr : *found;
}

}  // namespace

JointPlot::JointPlot(QWidget* parent) : CaseWidget(parent), counter_(new engine::JointCounter(this)) {
  setAccessibleName(tr("Two images against each other"));
  setToolTip(
      tr("How often a voxel has which value in the study (to the right) and in the second image (upwards).\n"
         "Orange points are strokes inside, blue crosses strokes outside: where they mix, the images do not\n"
         "tell them apart."));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  connect(counter_, &engine::JointCounter::answered, this, qOverload<>(&JointPlot::update));
}

bool JointPlot::fits(const document::Drive& drive) {
  return second_image(drive) != nullptr;
}

void JointPlot::attach() {
  counter_->forget();
}

void JointPlot::refresh() {
  if (const auto second = second_image(proxy()->drive()))
    counter_->ask({proxy()->source(), second, proxy()->drive().strokes});
  update();
}

QRectF JointPlot::plot() const {
  const double line = fontMetrics().height() + 2.0;
  return QRectF(rect()).adjusted(line + 2.0, 4.0, -kSpace, -line - 2.0);
}

QPointF JointPlot::position_of(const JointHistogram::Place& place) const {
  const QRectF area = plot();
  const auto share = [](float value) { return std::clamp(static_cast<double>(value), 0.0, 1.0); };
  return {area.left() + share(place[0]) * area.width(), area.bottom() - share(place[1]) * area.height()};
}

void JointPlot::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.fillRect(rect(), palette().color(QPalette::Base));
  if (!histogram()) {
    const QString& problem = counter_->problem();
    painter.setPen(palette().color(QPalette::PlaceholderText));
    painter.drawText(rect(), Qt::AlignCenter | Qt::TextWordWrap,
                     problem.isEmpty() ? tr("Counting…") : problem);
    return;
  }
  paint_counts(painter);
  paint_axes(painter);
  paint_points(painter);  // over the frame: many lie at the ends
}

// Grey by the logarithm of the count: rare pairs of values are seen beside those of the air.
void JointPlot::paint_counts(QPainter& painter) const {
  const std::vector<std::int64_t>& counts = histogram()->counts;
  const double most = std::log1p(static_cast<double>(*std::ranges::max_element(counts)));
  if (most <= 0.0) return;
  const QColor none = palette().color(QPalette::Base);
  const QColor full = palette().color(QPalette::Text);
  QImage image(JointHistogram::kBins, JointHistogram::kBins, QImage::Format_RGB32);
  for (int y = 0; y < JointHistogram::kBins; ++y) {
    for (int x = 0; x < JointHistogram::kBins; ++x) {
      const auto bin = static_cast<std::size_t>(x + JointHistogram::kBins * y);
      const double share = std::log1p(static_cast<double>(counts[bin])) / most;
      image.setPixelColor(x, JointHistogram::kBins - 1 - y, mixed(none, full, 0.85 * share));
    }
  }
  painter.drawImage(plot(), image);
}

void JointPlot::paint_points(QPainter& painter) const {
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(kOutsideStroke, 1.2));
  for (const JointHistogram::Place& place : histogram()->outside) {
    const QPointF at = position_of(place);
    painter.drawLine(at + QPointF(-kPoint, -kPoint), at + QPointF(kPoint, kPoint));
    painter.drawLine(at + QPointF(-kPoint, kPoint), at + QPointF(kPoint, -kPoint));
  }
  painter.setPen(Qt::NoPen);
  painter.setBrush(kInsideStroke);
  for (const JointHistogram::Place& place : histogram()->inside) {
    painter.drawEllipse(position_of(place), kPoint, kPoint);
  }
  painter.setRenderHint(QPainter::Antialiasing, false);
}

// The ends of the common values, and between them whose they are.
void JointPlot::paint_axes(QPainter& painter) const {
  const QRectF area = plot();
  painter.setPen(palette().color(QPalette::Mid));
  painter.setBrush(Qt::NoBrush);
  painter.drawRect(area);
  painter.setPen(palette().color(QPalette::Text));
  const auto second = proxy() ? second_image(proxy()->drive()) : nullptr;
  const double line = fontMetrics().height() + 2.0;
  const auto axis = [&](const QRectF& where, std::size_t image, const QString& name) {
    const auto [low, high] = histogram()->ranges[image];
    const int decimals = decimals_for(static_cast<double>(high) - static_cast<double>(low));
    const QString from = number_text(low, decimals);
    const QString to = number_text(high, decimals);
    painter.drawText(where, Qt::AlignLeft | Qt::AlignVCenter, from);
    painter.drawText(where, Qt::AlignRight | Qt::AlignVCenter, to);
    const double room = where.width() - fontMetrics().horizontalAdvance(from + to) - 2.0 * kSpace;
    const QString shown = fontMetrics().elidedText(name, Qt::ElideRight, static_cast<int>(room));
    if (room > 0.0) painter.drawText(where, Qt::AlignHCenter | Qt::AlignVCenter, shown);
  };
  axis({area.left(), area.bottom() + 2.0, area.width(), line}, 0, tr("Study"));
  painter.save();
  painter.translate(area.left() - line - 2.0, area.bottom());
  painter.rotate(-90.0);
  axis({0.0, 0.0, area.height(), line}, 1, second ? QString::fromStdString(second->name) : QString());
  painter.restore();
}

}  // namespace tidemark::ui
