// The common base of drags that paint a label. The label changes when the button is released; until then
// slices show the stroke.
#pragma once

#include "core/region.h"
#include "ui/views/drag.h"

namespace tidemark::ui {

// The left button adds, the right one takes away.
class LabelStroke : public Drag {
 public:
  LabelStroke(DragView view, const Pointer& pressed);
  ~LabelStroke() override;
  void release() override;
  [[nodiscard]] QString text() const override;

 protected:
  [[nodiscard]] const Region& region() const { return region_; }
  void show(Region region);  // what the stroke is so far
  // Of offsets in the volume's grid.
  [[nodiscard]] Region region_of(const std::vector<std::int64_t>& voxels) const;

 private:
  [[nodiscard]] std::uint8_t label() const;  // 0: a new one, because there is none

  document::Labels::Stroke what_;
  Region region_;
};

}  // namespace tidemark::ui
