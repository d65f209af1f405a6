#include "ui/views/label_drag.h"

#include <algorithm>
#include <glm/common.hpp>

#include "ui/views/mark_drags.h"

namespace tidemark::ui {
namespace {

Index3 voxel_at(const Geometry& grid, glm::dvec3 patient_mm) {
  return glm::clamp(Index3(glm::round(grid.to_voxel(patient_mm))), Index3(0), grid.size - Index3(1));
}

}  // namespace

LabelDrag::LabelDrag(DragView view, const Pointer& pressed)
    : LabelStroke(std::move(view), pressed),
      radius_mm_(display().settings().brush_mm),
      last_mm_(*pressed.patient_mm) {
  if (!this->view().slab || pressed.modifiers.testFlag(Qt::ShiftModifier))
    ball_ = imaging::ball_of(proxy().volume().geometry, radius_mm_);
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
  add(ball_ ? balls(way) : discs(way));
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
  std::vector<Index3> centres;
  VoxelRange box{grid.size, Index3(0)};
  for (const glm::dvec3& place : way) {
    centres.push_back(voxel_at(grid, place));
    box = {glm::min(box.low, centres.back()), glm::max(box.high, centres.back() + Index3(1))};
  }
  Region region(box.widened(ball_->reach, grid.size));
  for (const Index3& centre : centres) {
    for (const imaging::BallRow& row : ball_->rows) {
      const Index3 middle = centre + Index3(0, row.j, row.k);
      if (!region.has_row(middle.y, middle.z)) continue;
      const std::int64_t first = std::max<std::int64_t>(middle.x - row.half, 0);
      const std::int64_t end = std::min(middle.x + row.half + 1, grid.size.x);
      region.add_run({first, middle.y, middle.z}, end - first);
    }
  }
  return region;
}

void LabelDrag::move(const Pointer& pointer) {
  if (!pointer.patient_mm || *pointer.patient_mm == last_mm_) return;
  dab(last_mm_, *pointer.patient_mm);
  last_mm_ = *pointer.patient_mm;
}

}  // namespace tidemark::ui
