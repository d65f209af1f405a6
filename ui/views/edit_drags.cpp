#include "ui/views/edit_drags.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "ui/views/mark_drags.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {

SphereDrag::SphereDrag(DragView view, const Pointer& pressed, solver::Brush brush)
    : Drag(std::move(view)),
      brush_(brush),
      centre_mm_(*pressed.patient_mm),
      radius_mm_(display().settings().brush_mm) {
  show();
}

SphereDrag::~SphereDrag() {
  display().set_drawn_sphere(std::nullopt);
}

void SphereDrag::show() {
  display().set_drawn_sphere(engine::DrawnSphere{{centre_mm_, radius_mm_}, brush_ == solver::Brush::erase});
}

void SphereDrag::move(const Pointer& pointer) {
  if (!pointer.patient_mm) return;
  // A click alone makes a sphere of the brush's size.
  const double way_mm = glm::distance(*pointer.patient_mm, centre_mm_);
  if (way_mm > 2.0 * view().mm_per_pixel) radius_mm_ = way_mm;
  show();
}

void SphereDrag::release() {
  proxy().paint({centre_mm_, radius_mm_}, brush_, engine::CaseProxy::new_gesture());
}

QString SphereDrag::text() const {
  return QCoreApplication::translate("SphereDrag", "radius %1 mm").arg(number_text(radius_mm_, 1));
}

StrokeDrag::StrokeDrag(DragView view, const Pointer& pressed, solver::Brush brush)
    : Drag(std::move(view)),
      brush_(brush),
      gesture_(engine::CaseProxy::new_gesture()),
      radius_mm_(display().settings().brush_mm),
      last_mm_(*pressed.patient_mm) {
  dab(last_mm_);
}

void StrokeDrag::dab(glm::dvec3 at_mm) {
  proxy().paint({at_mm, radius_mm_}, brush_, gesture_);
  spheres_.push_back({at_mm, radius_mm_});
}

void StrokeDrag::release() {
  if (brush_ != solver::Brush::erase || !display().settings().wall_behind_eraser) return;
  proxy().change_drive(
      [geometry = proxy().volume().geometry, spheres = spheres_](document::Drive& drive) {
        drive.constraints =
            with_spheres(drive.constraints.get(), geometry, spheres, solver::Constraint::wall);
      },
      gesture_);
}

void StrokeDrag::move(const Pointer& pointer) {
  if (!pointer.patient_mm) return;
  // Spheres so near to each other that the stroke looks like a tube.
  const double stride_mm = 0.4 * radius_mm_;
  const glm::dvec3 way = *pointer.patient_mm - last_mm_;
  const auto strides = static_cast<int>(glm::length(way) / stride_mm);
  for (int stride = 1; stride <= strides; ++stride) {
    dab(last_mm_ + way * (static_cast<double>(stride) / strides));
  }
  if (strides > 0) last_mm_ = *pointer.patient_mm;
}

}  // namespace tidemark::ui
