// The drag of the brush that paints a label.
#pragma once

#include "imaging/regions/ball.h"
#include "ui/views/label_stroke.h"

namespace tidemark::ui {

// Discs in the slice, balls with Shift and in 3D; with Ctrl only voxels whose values are as near to that of
// the first one as epsilon says.
class LabelDrag : public LabelStroke {
 public:
  LabelDrag(DragView view, const Pointer& pressed);
  void move(const Pointer& pointer) override;

 private:
  void dab(glm::dvec3 from_mm, glm::dvec3 to_mm);
  [[nodiscard]] Region discs(const std::vector<glm::dvec3>& way) const;
  [[nodiscard]] Region balls(const std::vector<glm::dvec3>& way) const;

  double radius_mm_;
  std::optional<imaging::Ball> ball_;  // none: discs
  glm::dvec3 last_mm_;
};

}  // namespace tidemark::ui
