// The common base of drags that paint a label. The label changes when the button is released; until then
// slices show the stroke.
#pragma once

#include <optional>

#include "core/region.h"
#include "ui/views/drag.h"

namespace tidemark::ui {

// The left button adds, the right one takes away.
class LabelStroke : public Drag {
 public:
  LabelStroke(DragView view, const Pointer& pressed);
  ~LabelStroke() override;
  [[nodiscard]] bool acts_at_its_end() const override { return true; }
  void release() override;
  [[nodiscard]] QString text() const override;

 protected:
  // What the stroke is so far, and what it takes in, but for voxels whose values it leaves out.
  void show(const Region& region);
  void add(const Region& region);
  // The stroke changes voxels with these values alone, from now on.
  void keep_to(const engine::ValueRange& values) { values_ = values; }
  // Of offsets in the volume's grid.
  [[nodiscard]] Region region_of(const std::vector<std::int64_t>& voxels) const;

 private:
  [[nodiscard]] std::uint8_t label() const;  // 0: there is none yet
  [[nodiscard]] Region with_values(const Region& region) const;
  void show_preview();

  document::Labels::Stroke what_;
  std::optional<engine::ValueRange> values_;
  Region region_;
};

}  // namespace tidemark::ui
