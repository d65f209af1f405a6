#include "ui/panels/evolution_figures.h"

#include <QCheckBox>
#include <QLabel>

#include "ui/panels/curve_plot.h"
#include "ui/widgets/disclosure.h"
#include "ui/widgets/form.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {

EvolutionFigures::EvolutionFigures(QWidget* parent) : CaseWidget(parent) {
  Form form(this);
  form.heading(tr("Figures"));
  step_ = form.figure(tr("Step"), tr("Steps since the surface was placed."));
  dice_part_ = new QWidget;
  Form truth(dice_part_);
  dice_ =
      truth.figure(tr("Dice"), tr("How well the surface agrees with the phantom's true shape: 1 is all of "
                                  "it and nothing else, 0 nothing of it."));
  truth_ =
      truth.check(tr("Show the truth"), tr("Draws the outline of the true shape into slices, in violet."));
  connect(truth_, &QCheckBox::clicked, this, [this](bool on) {
    change_display([=](engine::DisplaySettings& settings) { settings.truth = on; });
  });
  dice_part_->hide();  // until there is a phantom
  form.wide(dice_part_);
  add_curves(form);
  auto* fold = new Disclosure(tr("Details of the figures"), QStringLiteral("figures"));
  form.wide(fold);
  Form details(fold->content());
  add_details(details);
}

void EvolutionFigures::add_details(Form& form) {
  pace_ = form.figure(tr("Steps per second"), tr("While it plays: with the time for pictures. Else: in the "
                                                 "solver's own time."));
  pages_ = form.figure(tr("Resident pages"), tr("Pages of the level set that are in memory, those near the "
                                                "surface; and how many of them rest."));
  bytes_ = form.figure(tr("Memory"), tr("What the level set takes, without the source."));
}

void EvolutionFigures::add_curves(Form& form) {
  form.heading(tr("Over the steps"));
  volume_ = new CurvePlot(tr("Volume"), tr("ml"), false);
  area_ = new CurvePlot(tr("Area"), tr("mm²"), false);
  motion_ = new CurvePlot(tr("Motion"), QString(), true);
  volume_->setToolTip(tr("The volume inside the surface, over the steps."));
  area_->setToolTip(tr("The area of the surface, over the steps."));
  motion_->set_mark(solver::kConvergedSpeed,
                    tr("How fast the surface moves, on a logarithmic scale: 1 is a front "
                       "that the data drives as fast as can be. Below the dashed line (%1) it "
                       "counts as converged.")
                        .arg(number_text(solver::kConvergedSpeed, 2)));
  for (CurvePlot* plot : {volume_, area_, motion_}) form.wide(plot);
}

void EvolutionFigures::attach() {
  dice_part_->setVisible(proxy() && proxy()->study().truth);
  if (proxy()) return;
  for (CurvePlot* plot : {volume_, area_, motion_}) plot->set_points({});
  for (QLabel* figure : {step_, dice_, pages_, bytes_, pace_}) figure->clear();
}

void EvolutionFigures::show_curves() {
  const document::Curve::Points& curve = *proxy()->state().curve.points();
  const auto show = [&curve](CurvePlot* plot, double document::CurvePoint::*quantity) {
    std::vector<QPointF> points;
    points.reserve(curve.size());
    for (const document::CurvePoint& point : curve)
      points.emplace_back(static_cast<double>(point.step), point.*quantity);
    plot->set_points(std::move(points));
  };
  show(volume_, &document::CurvePoint::volume_ml);
  show(area_, &document::CurvePoint::surface_mm2);
  show(motion_, &document::CurvePoint::surface_speed);
}

void EvolutionFigures::refresh() {
  const engine::CaseState& state = proxy()->state();
  show_curves();
  step_->setText(count_text(state.step));
  dice_->setText(state.begun && state.dice ? number_text(*state.dice, 3) : QStringLiteral("–"));
  truth_->setChecked(proxy()->display().settings().truth);
  const double measured = state.playing ? state.steps_per_second : state.solver_steps_per_second;
  const double pace = document::has_surface(state.outcome) ? measured : 0.0;
  pace_->setText(pace > 0.0 ? short_text(pace) : QStringLiteral("–"));
  pages_->setText(tr("%1, %2 at rest")
                      .arg(count_text(state.memory.resident_pages), count_text(state.memory.quiet_pages)));
  bytes_->setText(number_locale().formattedDataSize(state.memory.state_bytes, 1, QLocale::DataSizeSIFormat));
}

}  // namespace tidemark::ui
