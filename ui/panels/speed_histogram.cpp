#include "ui/panels/speed_histogram.h"

#include <QPainter>
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "engine/slice_slab.h"
#include "renderer/camera.h"
#include "ui/look/theme.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {
namespace {

constexpr std::size_t kHistogramBars = 40;
constexpr double kDoubt = 0.5;  // |D| below which p is between a quarter and three quarters

// The slice of the grid that lies most across the patient, at the crosshair.
engine::SpeedSampler::Question slice_of(engine::CaseProxy& proxy) {
  const Geometry& geometry = proxy.volume().geometry;
  const glm::dvec3 cursor_mm = proxy.display().settings().cursor_mm;
  const int across = engine::SliceSlab(geometry, cursor_mm, renderer::kAxial.into()).axes()[2];
  const Index3 cursor(glm::round(geometry.to_voxel(cursor_mm)));
  engine::SpeedSampler::Question question{proxy.state().speed, Index3(0), geometry.size};
  question.first[across] = std::clamp<std::int64_t>(cursor[across], 0, geometry.size[across] - 1);
  question.size[across] = 1;
  return question;
}

}  // namespace

SpeedHistogram::SpeedHistogram(QWidget* parent)
    : CaseWidget(parent), sampler_(new engine::SpeedSampler(this)) {
  setAccessibleName(tr("Certainty of the speed function"));
  setToolTip(
      tr("How many voxels of the axial slice at the crosshair have which probability p = (D + 1) / 2.\n"
         "Right of the middle the surface grows. The more lies at both ends, the surer it is."));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  connect(sampler_, &engine::SpeedSampler::answered, this, &SpeedHistogram::count);
}

void SpeedHistogram::attach() {
  clear();
}

void SpeedHistogram::refresh() {
  if (proxy()->state().speed) {
    sampler_->ask(slice_of(*proxy()));
  } else {
    clear();
  }
  update();
}

void SpeedHistogram::clear() {
  sampler_->ask({});
  bars_.clear();
}

void SpeedHistogram::count() {
  const auto& values = *sampler_->answer();
  bars_.assign(kHistogramBars, 0.0);
  double growing = 0.0;
  double doubtful = 0.0;
  for (const double speed : values) {
    const double p = 0.5 * (speed + 1.0);
    const auto bar = static_cast<std::int64_t>(std::floor(p * static_cast<double>(kHistogramBars)));
    bars_[static_cast<std::size_t>(std::clamp<std::int64_t>(bar, 0, kHistogramBars - 1))] += 1.0;
    growing += speed > 0.0 ? 1.0 : 0.0;
    doubtful += std::abs(speed) < kDoubt ? 1.0 : 0.0;
  }
  const double all = std::max(1.0, static_cast<double>(values.size()));
  growing_ = growing / all;
  doubtful_ = doubtful / all;
  update();
}

void SpeedHistogram::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.fillRect(rect(), palette().color(QPalette::Base));
  const QFontMetricsF metrics(font());
  const double line = metrics.height() + 2.0;
  const QRectF area = QRectF(rect()).adjusted(kSpace, line, -kSpace, -line);
  painter.setPen(palette().color(QPalette::PlaceholderText));
  painter.drawLine(QPointF(area.center().x(), area.top()), area.center() + QPointF(0.0, area.height() / 2.0));
  const QRectF below(area.left(), area.bottom(), area.width(), line);
  painter.drawText(below, Qt::AlignLeft | Qt::AlignVCenter, tr("outside"));
  painter.drawText(below, Qt::AlignHCenter | Qt::AlignVCenter, tr("in doubt"));
  painter.drawText(below, Qt::AlignRight | Qt::AlignVCenter, tr("inside"));
  painter.setPen(palette().color(QPalette::Text));
  const QRectF above(area.left(), 0.0, area.width(), line);
  if (bars_.empty()) {
    const bool waits = proxy() && proxy()->state().speed_waits;
    painter.drawText(above, Qt::AlignLeft | Qt::AlignVCenter, waits ? tr("Learning…") : tr("Looking…"));
    return;
  }
  painter.drawText(above, Qt::AlignLeft | Qt::AlignVCenter,
                   tr("grows in %1 %, in doubt %2 %")
                       .arg(number_text(100.0 * growing_, 1), number_text(100.0 * doubtful_, 1)));
  const double most = std::log1p(*std::ranges::max_element(bars_));
  if (most <= 0.0) return;
  const double width = area.width() / static_cast<double>(kHistogramBars);
  painter.setPen(Qt::NoPen);
  // As in the speed map, but for a dark blue that would be lost on a dark panel.
  const QColor shrinking = is_dark(palette()) ? QColor(90, 170, 255) : QColor(33, 92, 171);
  for (std::size_t bar = 0; bar < kHistogramBars; ++bar) {
    const QColor colour = 2 * bar < kHistogramBars ? shrinking : QColor(204, 102, 13);
    const double high = area.height() * std::log1p(bars_[bar]) / most;
    painter.setBrush(QBrush(colour, 2 * bar < kHistogramBars ? Qt::Dense4Pattern : Qt::SolidPattern));
    painter.drawRect(QRectF(area.left() + static_cast<double>(bar) * width, area.bottom() - high,
                            std::max(1.0, width - 1.0), high));
  }
}

}  // namespace tidemark::ui
