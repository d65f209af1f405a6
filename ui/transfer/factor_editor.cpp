#include "ui/transfer/factor_editor.h"

#include <QGridLayout>
#include <QSignalBlocker>
#include <algorithm>
#include <cmath>

#include "ui/widgets/wheel_guard.h"

namespace tidemark::ui {
namespace {

using Kind = renderer::TransferFactor::Kind;

constexpr double kFarthest = 1e9;

NumberBox* number_box(QWidget* parent) {
  auto* box = new NumberBox(parent);
  box->setRange(-kFarthest, kFarthest);
  // Its width is the layout's: nine digits would make every panel wide.
  box->setMinimumWidth(64);
  box->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  guard_wheel(box);
  return box;
}

}  // namespace

FactorEditor::FactorEditor(QWidget* parent)
    : QWidget(parent), kind_(new QComboBox(this)), start_(number_box(this)), end_(number_box(this)) {
  kind_->addItem(tr("All"), static_cast<int>(Kind::everything));
  kind_->addItem(tr("Gaussian"), static_cast<int>(Kind::gaussian));
  kind_->addItem(tr("Ramp"), static_cast<int>(Kind::ramp));
  guard_wheel(kind_);
  // The numbers below the kind, and only where they matter: a panel has no room for both in a row.
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setSpacing(4);
  grid->addWidget(kind_, 0, 0, 1, 2);
  grid->addWidget(start_, 1, 0);
  grid->addWidget(end_, 1, 1);
  setFocusProxy(kind_);
  connect(kind_, &QComboBox::activated, this, &FactorEditor::take_kind);
  connect(start_, &NumberBox::valueChanged, this, &FactorEditor::take_numbers);
  connect(end_, &NumberBox::valueChanged, this, &FactorEditor::take_numbers);
}

void FactorEditor::set_axis(const PrimitiveAxis& axis) {
  axis_ = axis;
  for (NumberBox* box : {start_, end_}) {
    const QSignalBlocker quiet(box);
    suit_decimals(*box, axis.high - axis.low);
  }
  kind_->setAccessibleName(tr("%1: kind").arg(axis.name));
  kind_->setToolTip(tr("Whether the %1 matters, and how: around a centre, or from a start up to an end")
                        .arg(axis.name.toLower()));
  set_factor(factor_);
}

void FactorEditor::set_factor(const renderer::TransferFactor& factor) {
  factor_ = factor;
  const bool gaussian = factor.kind == Kind::gaussian;
  const bool matters = factor.kind != Kind::everything;
  const QSignalBlocker quiet_kind(kind_);
  kind_->setCurrentIndex(kind_->findData(static_cast<int>(factor.kind)));
  start_->setVisible(matters);
  end_->setVisible(matters);
  if (!matters) return;
  start_->setAccessibleName((gaussian ? tr("%1: centre") : tr("%1: start")).arg(axis_.name));
  end_->setAccessibleName((gaussian ? tr("%1: width") : tr("%1: end")).arg(axis_.name));
  start_->setToolTip(gaussian ? tr("Centre") : tr("Start: up to here nothing shows"));
  end_->setToolTip(gaussian ? tr("Width: so far from the centre, 37 % are left")
                            : tr("End: from here on all of it shows"));
  end_->setPrefix(gaussian ? QStringLiteral("± ") : QStringLiteral("→ "));
  const QSignalBlocker quiet_end(end_);
  end_->setMinimum(gaussian ? smallest() : -kFarthest);
  show_number(*start_, factor.start);
  show_number(*end_, factor.end);
}

double FactorEditor::smallest() const {
  return std::pow(10.0, -end_->decimals());
}

void FactorEditor::take_kind() {
  const auto kind = static_cast<Kind>(kind_->currentData().toInt());
  if (kind == factor_.kind) return;
  renderer::TransferFactor next = middle_factor(kind, axis_);
  // A Gaussian becomes a ramp where it is, and the other way round.
  if (kind == Kind::ramp && factor_.kind == Kind::gaussian) {
    next = {kind, factor_.start - factor_.end, factor_.start + factor_.end};
  } else if (kind == Kind::gaussian && factor_.kind == Kind::ramp) {
    next = {kind, 0.5 * (factor_.start + factor_.end), 0.5 * std::abs(factor_.end - factor_.start)};
  }
  set_factor(next);
  emit edited(next);
}

void FactorEditor::take_numbers() {
  renderer::TransferFactor next = factor_;
  // A box holds no more digits than it shows: the one that was not touched must not round the other number.
  if (sender() == start_) next.start = start_->value();
  if (sender() == end_) next.end = end_->value();
  if (next.kind == Kind::ramp && next.end == next.start) next.end += smallest();
  set_factor(next);
  emit edited(next);
}

void suit_decimals(NumberBox& box, double extent) {
  const int digits = static_cast<int>(std::floor(std::log10(std::max(extent, 1e-6))));
  box.setDecimals(std::clamp(3 - digits, 0, 9));
  box.setSingleStep(std::pow(10.0, digits - 2));
}

void show_number(NumberBox& box, double value) {
  const double shown = std::pow(10.0, -box.decimals()) * 0.51;
  if (std::abs(box.value() - value) < shown) return;
  const QSignalBlocker quiet(&box);
  box.setValue(value);
}

}  // namespace tidemark::ui
