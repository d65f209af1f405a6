#include "ui/panels/smoothing_controls.h"

#include <QLabel>
#include <QPushButton>
#include <algorithm>
#include <cmath>

#include "ui/widgets/form.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/slider_number.h"

namespace tidemark::ui {
namespace {

constexpr double kMostSmoothing = 5.0;  // mm
constexpr int kDecimals = 2;

}  // namespace

SmoothingControls::SmoothingControls(QWidget* parent) : CaseWidget(parent) {
  Form form(this);
  form.heading(tr("Noise"));
  now_ = form.note({});
  sigma_ = form.slider(tr("Smoothing σ"),
                       tr("Standard deviation of the Gaussian with which the level set's view "
                          "of the study is smoothed; 0: not at all. Pictures stay as they are."));
  sigma_->set_decimals(kDecimals);
  sigma_->set_range(0.0, kMostSmoothing);
  sigma_->set_step(0.1);
  sigma_->set_unit(tr("mm"));
  connect(sigma_, &SliderNumber::edited, this, &SmoothingControls::show_button);
  apply_ = new QPushButton(tr("Smooth"));
  apply_->setToolTip(tr("Smooths the study for the level set; takes some seconds where it is large."));
  form.wide(apply_);
  connect(apply_, &QPushButton::clicked, this, [this] {
    if (proxy()) proxy()->smooth_source(sigma_->value());
  });
}

void SmoothingControls::attach() {
  if (!proxy()) return;
  // A lesson or a recipe may have smoothed by more.
  const double now = proxy()->state().smoothed_mm;
  sigma_->set_range(0.0, std::max(kMostSmoothing, now));
  sigma_->set_value(now);
}

void SmoothingControls::refresh() {
  const double now = proxy()->state().smoothed_mm;
  const bool smooths = proxy()->state().smoothing.has_value();
  now_->setText(
      smooths ? tr("The study is being smoothed.")
      : now > 0.0
          ? tr("The level set sees the study smoothed by %1.").arg(number_text(now, kDecimals, tr("mm")))
          : tr("The level set sees the study unsmoothed."));
  show_button();
}

void SmoothingControls::show_button() {
  if (!proxy()) return;
  const double now = proxy()->state().smoothing.value_or(proxy()->state().smoothed_mm);
  const bool undoes = sigma_->value() == 0.0 && now > 0.0;
  apply_->setText(undoes ? tr("Use the unsmoothed study") : tr("Smooth"));
  apply_->setEnabled(std::abs(sigma_->value() - now) > 1e-6);
}

}  // namespace tidemark::ui
