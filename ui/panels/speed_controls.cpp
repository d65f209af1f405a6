#include "ui/panels/speed_controls.h"

#include <QCheckBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <cmath>

#include "engine/case_balance.h"
#include "ui/look/theme.h"
#include "ui/panels/joint_plot.h"
#include "ui/panels/speed_histogram.h"
#include "ui/panels/speed_plot.h"
#include "ui/panels/value_unit.h"
#include "ui/views/driven_by.h"
#include "ui/widgets/form.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/slider_number.h"

namespace tidemark::ui {

SpeedControls::SpeedControls(QWidget* parent) : CaseWidget(parent) {
  Form form(this);
  form_ = form.layout();
  tent_ = new SpeedPlot;
  form.wide(tent_);
  certainty_ = new SpeedHistogram;
  form.wide(certainty_);
  joint_ = new JointPlot;
  form.wide(joint_);
  show_row(*form_, certainty_, false);
  show_row(*form_, joint_, false);
  connect(tent_, &SpeedPlot::edited, this, [this](double target, double range, std::uint64_t gesture) {
    change(
        [=](solver::Parameters& parameters) {
          parameters.target = target;
          parameters.range = range;
        },
        gesture);
  });
  add_numbers(form);
}

void SpeedControls::add_numbers(Form& form) {
  target_ =
      form.slider(tr("Target T"), tr("The value of the wanted tissue: there the surface grows fastest."));
  range_ = form.slider(tr("Range ε"), tr("How far a value may be from T for the surface to grow there."));
  alpha_ =
      form.slider(tr("Data weight α"),
                  tr("How the data and the smoothing share the speed. 1 follows the data alone; at 0 the "
                     "surface only becomes smoother, and shrinks."));
  alpha_->set_range(0.0, 1.0);
  alpha_->set_decimals(3);
  alpha_->set_step(0.01);
  form.ends_of(*alpha_, tr("smooth"), tr("follow data"));

  connect(target_, &SliderNumber::edited, this, [this](double value, std::uint64_t gesture) {
    change([value](solver::Parameters& parameters) { parameters.target = value; }, gesture);
  });
  connect(range_, &SliderNumber::edited, this, [this](double value, std::uint64_t gesture) {
    change([value](solver::Parameters& parameters) { parameters.range = value; }, gesture);
  });
  connect(alpha_, &SliderNumber::edited, this, [this](double value, std::uint64_t gesture) {
    change([value](solver::Parameters& parameters) { parameters.alpha = value; }, gesture);
  });
}

void SpeedControls::attach() {
  certainty_->set_proxy(proxy());
  joint_->set_proxy(proxy());
  disconnect(explained_);
  if (!proxy()) return;
  explained_ = connect(&proxy()->balance(), &engine::CaseBalance::changed, this, &SpeedControls::show_mark);
  const engine::SourceSummary& summary = proxy()->summary();
  const QString unit = value_unit(proxy()->volume());
  const double span = std::max<double>(summary.high - summary.low, 1e-6);
  const double all = std::max<double>(summary.highest - summary.lowest, span);
  const int decimals = value_decimals(span);  // as in the bar over a view
  const double step = std::pow(10.0, -decimals_for(span));
  tent_->set_source(summary, unit);
  target_->set_decimals(decimals);
  target_->set_step(step);
  target_->set_range(summary.low, summary.high, summary.lowest - all, summary.highest + all);
  target_->set_unit(unit);
  const double smallest = std::max(solver::kMinimumRange, std::pow(10.0, -decimals));
  range_->set_decimals(decimals);
  range_->set_step(step);
  range_->set_range(std::max(smallest, span / 1000.0), span, smallest, 2.0 * all,
                    SliderNumber::Scale::logarithmic);
  range_->set_unit(unit);
}

// The brightness of the place that is explained.
void SpeedControls::show_mark() {
  const auto& place = proxy()->balance().place();
  tent_->set_mark(place ? std::optional(place->balance.intensity) : std::nullopt);
}

void SpeedControls::refresh() {
  const solver::Parameters& parameters = proxy()->parameters();
  // T and epsilon are the tent's.
  const bool has_tent = is_driven_by(proxy()->drive(), "tent");
  for (QWidget* of_tent :
       {static_cast<QWidget*>(tent_), static_cast<QWidget*>(target_), static_cast<QWidget*>(range_)})
    show_row(*form_, of_tent, has_tent);
  show_row(*form_, certainty_, !proxy()->drive().setting.is_tent());
  // What learns sees all images; the others see one.
  show_row(*form_, joint_, is_driven_by(proxy()->drive(), "examples") && JointPlot::fits(proxy()->drive()));
  show_mark();
  tent_->set_tent(parameters.target, parameters.range);
  target_->set_value(parameters.target);
  range_->set_value(parameters.range);
  alpha_->set_value(parameters.alpha);
}

void SpeedControls::change(const engine::CaseProxy::ParameterChange& apply, std::uint64_t gesture) {
  if (proxy()) proxy()->change_parameters(apply, gesture);
}

}  // namespace tidemark::ui
