// The drag that paints a label. The label changes when the button is released; until then slices show the
// stroke.
#pragma once

#include "core/region.h"
#include "ui/views/drag.h"

namespace tidemark::ui {

// Discs in the slice, balls with Shift and in 3D; with Ctrl only voxels whose values are as near to that of
// the first one as epsilon says. The left button adds, the right one takes away.
class LabelDrag : public Drag {
 public:
  LabelDrag(DragView view, const Pointer& pressed);
  ~LabelDrag() override;
  void move(const Pointer& pointer) override;
  void release() override;
  [[nodiscard]] QString text() const override;

 private:
  void dab(glm::dvec3 from_mm, glm::dvec3 to_mm);
  [[nodiscard]] std::uint8_t label() const;  // 0: a new one, because there is none
  [[nodiscard]] Region discs(const std::vector<glm::dvec3>& way) const;
  [[nodiscard]] Region balls(const std::vector<glm::dvec3>& way) const;
  [[nodiscard]] Region like_the_first(const Region& region) const;

  document::Labels::Stroke what_;
  bool is_ball_;
  double radius_mm_;
  std::optional<double> value_;  // with which voxels are compared
  glm::dvec3 last_mm_;
  Region region_;
};

}  // namespace tidemark::ui
