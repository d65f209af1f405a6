#include "ui/widgets/slider_number.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QSignalBlocker>
#include <QSlider>
#include <algorithm>
#include <cmath>

#include "engine/case_proxy.h"
#include "ui/look/theme.h"
#include "ui/widgets/number_box.h"
#include "ui/widgets/wheel_guard.h"

namespace tidemark::ui {
namespace {

constexpr int kPositions = 1000;
constexpr qint64 kSameGestureMs = 700;  // between two presses of a key
constexpr int kArrows = 26;             // of the spin box, and its edges

}  // namespace

SliderNumber::SliderNumber(QWidget* parent)
    : QWidget(parent), slider_(new QSlider(Qt::Horizontal)), number_(new NumberBox) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(kSpace);
  row->addWidget(slider_, 1);
  row->addWidget(number_);
  slider_->setRange(0, kPositions);
  slider_->setSingleStep(kPositions / 100);
  slider_->setPageStep(kPositions / 10);
  slider_->setMinimumWidth(48);
  number_->setAlignment(Qt::AlignRight);
  fit_number();
  setFocusProxy(number_);
  guard_wheel(slider_);
  guard_wheel(number_);
  connect(slider_, &QSlider::sliderPressed, this, &SliderNumber::begin_gesture);
  connect(slider_, &QSlider::sliderReleased, this, [this] { gesture_ = 0; });
  connect(slider_, &QSlider::valueChanged, this, &SliderNumber::slider_moved);
  connect(number_, &NumberBox::valueChanged, this, &SliderNumber::number_changed);
}

void SliderNumber::fit_number() {
  const QString fine = QStringLiteral("-0.") + QString(number_->decimals(), u'0');
  const QFontMetrics metrics = fontMetrics();
  number_->setFixedWidth(kArrows + std::max(metrics.horizontalAdvance(QStringLiteral("-0000.0 HU")),
                                            metrics.horizontalAdvance(fine)));
}

void SliderNumber::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::FontChange) fit_number();
}

void SliderNumber::set_range(double low, double high, double least, double most, Scale scale) {
  if (low == low_ && high == high_ && least == number_->minimum() && most == number_->maximum() &&
      scale == scale_)
    return;
  const QSignalBlocker quiet(number_);
  low_ = low;
  high_ = high != low ? high : low + 1.0;
  scale_ = scale;
  number_->setRange(least, std::max(least, most));
  show_in_slider(number_->value());
}

void SliderNumber::set_decimals(int decimals) {
  const QSignalBlocker quiet(number_);
  number_->setDecimals(decimals);
  number_->setSingleStep(std::pow(10.0, -decimals));
  fit_number();
}

void SliderNumber::set_step(double step) {
  number_->setSingleStep(step);
}

void SliderNumber::set_unit(const QString& unit) {
  number_->setSuffix(unit.isEmpty() ? QString() : QChar(QChar::Nbsp) + unit);
}

void SliderNumber::set_value(double value) {
  if (slider_->isSliderDown()) return;  // by the mouse
  number_->show_unless_typed(value);
  show_in_slider(value);
}

double SliderNumber::value() const {
  return number_->value();
}

void SliderNumber::set_name(const QString& name, const QString& tip) {
  setToolTip(tip);
  for (QWidget* part : {static_cast<QWidget*>(slider_), static_cast<QWidget*>(number_)}) {
    part->setAccessibleName(name);
    part->setToolTip(tip);
  }
}

double SliderNumber::value_at(int position) const {
  const double share = static_cast<double>(position) / kPositions;
  if (scale_ == Scale::logarithmic) return low_ * std::pow(high_ / low_, share);
  return low_ + share * (high_ - low_);
}

void SliderNumber::show_in_slider(double value) {
  double share = (value - low_) / (high_ - low_);
  if (scale_ == Scale::logarithmic) share = std::log(std::max(value, low_) / low_) / std::log(high_ / low_);
  const QSignalBlocker quiet(slider_);
  slider_->setValue(static_cast<int>(std::lround(std::clamp(share, 0.0, 1.0) * kPositions)));
}

void SliderNumber::slider_moved() {
  {
    const QSignalBlocker quiet(number_);
    number_->setValue(value_at(slider_->value()));
  }
  announce();
}

void SliderNumber::number_changed(double value) {
  show_in_slider(value);
  announce();
}

void SliderNumber::begin_gesture() {
  gesture_ = engine::CaseProxy::new_gesture();
}

void SliderNumber::announce() {
  const bool follows =
      slider_->isSliderDown() || (since_edit_.isValid() && since_edit_.elapsed() < kSameGestureMs);
  if (gesture_ == 0 || !follows) begin_gesture();
  since_edit_.start();
  emit edited(number_->value(), gesture_);
}

}  // namespace tidemark::ui
