#include "ui/panels/prediction_text.h"

#include <QStringList>
#include <algorithm>

#include "solver/ball.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/tr.h"

namespace tidemark::ui {
namespace {

using document::Prediction;

QString length_text(double mm) {
  return number_text(mm, 2, tr("mm"));
}

QString text_of_end(const Prediction& prediction) {
  const document::PredictedPoint& last = prediction.points.back();
  const QString step = count_text(last.step);
  switch (prediction.end) {
    case Prediction::End::vanishes:
      return tr("It vanishes at step %1.").arg(step);
    case Prediction::End::tissue:
      return tr("The law ends at step %1, at a radius of %2: there D is another one, or something holds the "
                "surface.")
          .arg(step, length_text(last.radius_mm));
    case Prediction::End::border:
      return tr("The law ends at step %1, where the ball reaches the volume's border.").arg(step);
    case Prediction::End::horizon:
      break;
  }
  return {};
}

}  // namespace

double smallest_spacing_mm(const Geometry& geometry) {
  return std::min({geometry.spacing_mm.x, geometry.spacing_mm.y, geometry.spacing_mm.z});
}

QString name_of_law(const solver::BallLaw& law) {
  if (law.shrinking == 0.0) return tr("R = R₀ + αDt");
  return law.growth == 0.0 ? tr("R = √(R₀² − 4(1−α)t)") : tr("dR/dt = αD − 2(1−α)/R");
}

QString text_of_prediction(const Prediction& prediction, double spacing_mm) {
  const solver::BallLaw& law = prediction.law;
  QStringList lines;
  lines << tr("Dashed: a ball in even tissue, by %1. R is in the smallest voxel spacing (%2), t in the "
              "equation's "
              "units of time.")
               .arg(name_of_law(law), length_text(spacing_mm));
  if (law.growth != 0.0)
    lines << tr("D = %1 all around the surface.").arg(number_text(prediction.data_speed, 2));
  if (const auto critical = law.critical_radius_mm())
    lines << tr("Balls below a radius of %1 shrink, larger ones grow.").arg(length_text(*critical));
  const document::PredictedPoint& first = prediction.points.front();
  lines << tr("It begins at step %1 with the radius measured there, %2. Whatever is steered begins it anew.")
               .arg(count_text(first.step), length_text(first.radius_mm));
  if (const QString end = text_of_end(prediction); !end.isEmpty()) lines << end;
  lines << tr(
      "It is the equation's law. Steps on a grid lag behind it by some hundredths of the way, most where "
      "rescaling draws a small ball inwards.");
  return lines.join('\n');
}

QString text_of_obstacle(Prediction::Obstacle obstacle) {
  switch (obstacle) {
    case Prediction::Obstacle::none:
      break;
    case Prediction::Obstacle::shape:
      return tr("There is no formula to compare with: the surface is not one ball, all within the volume.");
    case Prediction::Obstacle::speed:
      return tr("There is no formula to compare with: D is not the same all around the surface.");
    case Prediction::Obstacle::held:
      return tr("There is no formula to compare with: walls, anchors or a limit hold the surface.");
    case Prediction::Obstacle::follows:
      return tr("There is no formula to compare with: D depends on the surface, or carries it along.");
  }
  return {};
}

QString text_of_radius(const Prediction& prediction, const document::CurvePoint& measured) {
  const QString radius = length_text(solver::radius_of_ball_mm(measured.volume_ml));
  const auto predicted = prediction.radius_at(measured.step);
  if (!predicted) return tr("%1, the law has ended").arg(radius);
  return tr("%1, predicted %2").arg(radius, length_text(*predicted));
}

}  // namespace tidemark::ui
