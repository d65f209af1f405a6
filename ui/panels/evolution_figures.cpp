#include "ui/panels/evolution_figures.h"

#include <QLabel>
#include <QLocale>

#include "ui/panels/curve_plot.h"
#include "ui/widgets/form.h"
#include "ui/widgets/number_text.h"

namespace tidemark {

EvolutionFigures::EvolutionFigures(QWidget* parent) : CaseWidget(parent) {
  Form form(this);
  form.heading(tr("Figures"));
  step_ = form.figure(tr("Step"), tr("Steps since the start."));
  pace_ = form.figure(tr("Steps per second"), tr("While it plays: with the time for pictures. Else: in the "
                                                 "solver's own time."));
  pages_ = form.figure(tr("Resident pages"), tr("Pages of the level set that are in memory, those near the "
                                                "surface; and how many of them rest."));
  bytes_ = form.figure(tr("Memory"), tr("Of the level set, without the source."));
  form.heading(tr("Over the steps"));
  volume_ = new CurvePlot(tr("Volume"), tr("ml"), false);
  area_ = new CurvePlot(tr("Area"), tr("mm²"), false);
  motion_ = new CurvePlot(tr("Motion"), QString(), true);
  volume_->setToolTip(tr("Inside the surface."));
  area_->setToolTip(tr("Of the surface."));
  motion_->set_mark(kConvergedSpeed,
                    tr("How fast the surface moves, on a logarithmic scale: 1 is a front "
                       "that the data drives as fast as can be. Below the dashed line (%1) it "
                       "counts as converged.")
                        .arg(number_text(kConvergedSpeed, 2)));
  for (CurvePlot* plot : {volume_, area_, motion_}) form.wide(plot);
}

void EvolutionFigures::attach() {
  if (proxy()) return;
  for (CurvePlot* plot : {volume_, area_, motion_}) plot->set_points({});
  for (QLabel* figure : {step_, pages_, bytes_, pace_}) figure->clear();
}

void EvolutionFigures::show_curves() {
  const Curve::Points& curve = *proxy()->state().curve.points();
  const auto show = [&curve](CurvePlot* plot, double CurvePoint::*quantity) {
    std::vector<QPointF> points;
    points.reserve(curve.size());
    for (const CurvePoint& point : curve)
      points.emplace_back(static_cast<double>(point.step), point.*quantity);
    plot->set_points(std::move(points));
  };
  show(volume_, &CurvePoint::volume_ml);
  show(area_, &CurvePoint::surface_mm2);
  show(motion_, &CurvePoint::surface_speed);
}

void EvolutionFigures::refresh() {
  const CaseState& state = proxy()->state();
  show_curves();
  step_->setText(count_text(state.step));
  const double measured = state.playing ? state.steps_per_second : state.solver_steps_per_second;
  const double pace = has_surface(state.outcome) ? measured : 0.0;
  pace_->setText(pace > 0.0 ? short_text(pace) : QStringLiteral("–"));
  pages_->setText(tr("%1, %2 at rest")
                      .arg(count_text(state.memory.resident_pages), count_text(state.memory.quiet_pages)));
  bytes_->setText(QLocale().formattedDataSize(state.memory.state_bytes, 1, QLocale::DataSizeSIFormat));
}

}  // namespace tidemark
