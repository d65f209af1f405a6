#include "ui/views/label_drag.h"

#include <algorithm>
#include <glm/common.hpp>

#include "imaging/regions/margin.h"
#include "ui/views/mark_drags.h"

namespace tidemark::ui {
namespace {

Index3 voxel_at(const Geometry& grid, glm::dvec3 patient_mm) {
  return glm::clamp(Index3(glm::round(grid.to_voxel(patient_mm))), Index3(0), grid.size - Index3(1));
}

}  // namespace

LabelDrag::LabelDrag(DragView view, const Pointer& pressed)
    : LabelStroke(std::move(view), pressed),
      is_ball_(!this->view().slab || pressed.modifiers.testFlag(Qt::ShiftModifier)),
      radius_mm_(display().settings().brush_mm),
      last_mm_(*pressed.patient_mm) {
  if (pressed.modifiers.testFlag(Qt::ControlModifier)) {
    const Volume& source = *proxy().source();
    const auto value = static_cast<double>(source.value(voxel_at(source.geometry, last_mm_)));
    const double tolerance = proxy().parameters().range;
    keep_to({value - tolerance, value + tolerance});
  }
  dab(last_mm_, last_mm_);
}

void LabelDrag::dab(glm::dvec3 from_mm, glm::dvec3 to_mm) {
  const auto way = way_between(from_mm, to_mm, std::max(0.5 * radius_mm_, 0.1));
  show(united(region(), is_ball_ ? balls(way) : discs(way)));
}

Region LabelDrag::discs(const std::vector<glm::dvec3>& way) const {
  std::vector<std::int64_t> voxels;
  for (const glm::dvec3& place : way) {
    const std::vector<std::int64_t> disc = view().slab->disc(place, radius_mm_);
    voxels.insert(voxels.end(), disc.begin(), disc.end());
  }
  return region_of(voxels);
}

Region LabelDrag::balls(const std::vector<glm::dvec3>& way) const {
  const Geometry& grid = proxy().volume().geometry;
  Region centres;
  for (const glm::dvec3& place : way) {
    const Index3 voxel = voxel_at(grid, place);
    centres = united(centres, whole({voxel, voxel + Index3(1)}));
  }
  return imaging::grown(centres, grid, std::min(radius_mm_, imaging::kWidestMargin)).value_or(centres);
}

void LabelDrag::move(const Pointer& pointer) {
  if (!pointer.patient_mm || *pointer.patient_mm == last_mm_) return;
  dab(last_mm_, *pointer.patient_mm);
  last_mm_ = *pointer.patient_mm;
}

}  // namespace tidemark::ui
