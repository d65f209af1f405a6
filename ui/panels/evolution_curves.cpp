#include "ui/panels/evolution_curves.h"

#include <QLabel>
#include <algorithm>

#include "engine/case_prediction.h"
#include "ui/panels/curve_legend.h"
#include "ui/panels/curve_plot.h"
#include "ui/panels/prediction_text.h"
#include "ui/widgets/form.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {
namespace {

// How far ahead of the surface its prediction is drawn: so many steps, or half of those since it was made.
constexpr std::int64_t kAhead = 100;

std::int64_t last_shown(const document::Prediction& prediction, std::int64_t step) {
  const std::int64_t since = step - prediction.points.front().step;
  return step + std::max(kAhead, since / 2);
}

}  // namespace

EvolutionCurves::EvolutionCurves(QWidget* parent)
    : CaseWidget(parent), prediction_(new engine::CasePrediction(this)) {
  Form form(this);
  form.heading(tr("Over the steps"));
  predicted_part_ = new QWidget;
  Form predicted(predicted_part_);
  legend_ = new CurveLegend;
  predicted.wide(legend_);
  radius_ =
      predicted.figure(tr("Radius"), tr("Of the ball with the surface's volume, and what the law says."));
  form.wide(predicted_part_);
  predicted_part_->hide();
  volume_ = new CurvePlot(tr("Volume"), tr("ml"), false);
  area_ = new CurvePlot(tr("Area"), tr("mm²"), false);
  motion_ = new CurvePlot(tr("Motion"), QString(), true);
  dice_ = new CurvePlot(tr("Dice"), QString(), false);
  dice_->setToolTip(tr("How well the surface agrees with the true shape, over the steps."));
  motion_->set_mark(solver::kConvergedSpeed,
                    tr("How fast the surface moves where it moves most, on a logarithmic scale: 1 is a front "
                       "that the data drives as fast as can be. It has converged when it has stayed "
                       "near the dashed line (%1) or below it for a while, everywhere.")
                        .arg(number_text(solver::kConvergedSpeed, 2)));
  for (CurvePlot* plot : {volume_, area_, motion_, dice_}) form.wide(plot);
  dice_->hide();  // until there is a truth
  connect(prediction_, &engine::CasePrediction::answered, this, &EvolutionCurves::show_predicted);
}

void EvolutionCurves::attach() {
  prediction_->forget();
  if (proxy()) return;
  dice_->hide();
  for (CurvePlot* plot : {volume_, area_, motion_, dice_}) plot->set_points({});
  show_predicted();
}

void EvolutionCurves::refresh() {
  dice_->setVisible(proxy()->truth() != nullptr);
  prediction_->follow(proxy()->state());
  show_measured();
  show_predicted();
}

void EvolutionCurves::show_measured() {
  const document::Curve::Points& curve = *proxy()->state().curve.points();
  const auto points_of = [&curve](double document::CurvePoint::*quantity) {
    std::vector<QPointF> points;
    points.reserve(curve.size());
    for (const document::CurvePoint& point : curve)
      points.emplace_back(static_cast<double>(point.step), point.*quantity);
    return points;
  };
  volume_->set_points(points_of(&document::CurvePoint::volume_ml));
  area_->set_points(points_of(&document::CurvePoint::surface_mm2));
  std::vector<QPointF> motion = points_of(&document::CurvePoint::surface_speed);
  // Before the first step none is known.
  if (!motion.empty() && !(motion.front().y() > 0.0)) motion.erase(motion.begin());
  motion_->set_points(std::move(motion));
  std::vector<QPointF> dice;
  for (const document::CurvePoint& point : curve) {
    if (point.dice) dice.emplace_back(static_cast<double>(point.step), *point.dice);
  }
  dice_->set_points(std::move(dice));
}

void EvolutionCurves::show_predicted() {
  const document::Prediction* prediction = proxy() ? prediction_->prediction() : nullptr;
  const bool holds = prediction && prediction->holds();
  predicted_part_->setVisible(holds);
  std::vector<QPointF> volumes;
  std::vector<QPointF> areas;
  QString about;
  if (holds) {
    const document::CurvePoint& newest = proxy()->state().curve.points()->back();
    const std::int64_t last = last_shown(*prediction, newest.step);
    for (const document::PredictedPoint& point : prediction->points) {
      if (point.step > last && volumes.size() > 1) break;
      const auto step = static_cast<double>(point.step);
      volumes.emplace_back(step, solver::volume_of_ball_ml(point.radius_mm));
      areas.emplace_back(step, solver::area_of_ball_mm2(point.radius_mm));
    }
    const double spacing_mm = smallest_spacing_mm(proxy()->volume().geometry);
    legend_->set_predicted(name_of_law(prediction->law));
    about = text_of_prediction(*prediction, spacing_mm);
    radius_->setText(text_of_radius(*prediction, newest));
  } else if (prediction) {
    about = text_of_obstacle(prediction->obstacle);
  }
  legend_->setToolTip(about);
  volume_->set_predicted(std::move(volumes));
  area_->set_predicted(std::move(areas));
  const auto tip = [&about](const QString& what) { return about.isEmpty() ? what : what + "\n\n" + about; };
  volume_->setToolTip(tip(tr("The volume inside the surface, over the steps.")));
  area_->setToolTip(tip(tr("The area of the surface, over the steps.")));
  show_steps();
}

// The same for all, so that each step has one place.
void EvolutionCurves::show_steps() {
  if (!proxy() || proxy()->state().curve.points()->empty()) return;
  const document::Curve::Points& curve = *proxy()->state().curve.points();
  const auto first = static_cast<double>(curve.front().step);
  double last = std::max(static_cast<double>(curve.back().step), first + 1.0);
  for (const CurvePlot* plot : {volume_, area_}) {
    if (!plot->predicted().empty()) last = std::max(last, plot->predicted().back().x());
  }
  for (CurvePlot* plot : {volume_, area_, motion_, dice_}) plot->set_steps({first, last});
}

}  // namespace tidemark::ui
