// Arrows of the speed terms over a view, and the mark of a place that is explained.
#pragma once

#include <QPainter>
#include <functional>
#include <vector>

#include "engine/case_balance.h"
#include "engine/force_sampler.h"

namespace tidemark::ui {

// A view as arrows see it.
struct SurfaceScreen {
  std::function<QPointF(glm::dvec3)> position_of;     // of a point of the patient, in logical pixels
  std::function<bool(glm::dvec3, glm::dvec3)> shows;  // a place on the surface with that outward normal
  double mm_per_pixel = 1.0;
  QSizeF size;
};

// Of the data, of curvature, of advection where there is one, and of all terms together, each as long as its
// push, and a line that says which is which and how long is how much. `spacing_mm`: the smallest.
void paint_forces(QPainter& painter, const std::vector<engine::PlaceForces>& forces, double spacing_mm,
                  const SurfaceScreen& screen);

// A ring, and how fast the surface moves there.
void paint_explained_place(QPainter& painter, const engine::ExplainedPlace& place,
                           const SurfaceScreen& screen);

}  // namespace tidemark::ui
