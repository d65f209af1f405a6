// Words for the prediction of a ball.
#pragma once

#include <QString>

#include "document/curve.h"
#include "document/prediction.h"

namespace tidemark::ui {

[[nodiscard]] double smallest_spacing_mm(const Geometry& geometry);
// The formula: "R = √(R₀² − 4t)".
[[nodiscard]] QString name_of_law(const solver::BallLaw& law);
// What it rests on and where it ends.
[[nodiscard]] QString text_of_prediction(const document::Prediction& prediction, double spacing_mm);
// Why there is none.
[[nodiscard]] QString text_of_obstacle(document::Prediction::Obstacle obstacle);
// The radius of a measured surface, and the predicted one: "11.9 mm, predicted 12.0 mm".
[[nodiscard]] QString text_of_radius(const document::Prediction& prediction,
                                     const document::CurvePoint& measured);

}  // namespace tidemark::ui
