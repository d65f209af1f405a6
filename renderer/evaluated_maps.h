// The maps that the processor evaluates where pictures show them: D, its doubt, and how far the surface has
// moved.
#pragma once

#include "renderer/speed_picture.h"
#include "renderer/views.h"

namespace tidemark::renderer {

class EvaluatedMaps {
 public:
  EvaluatedMaps() = default;
  explicit EvaluatedMaps(Index3 volume_size)
      : speed_(volume_size), doubt_(volume_size), change_(volume_size) {}

  // Null: the tent, which has no doubt.
  void set_speed(std::shared_ptr<const solver::SpeedFunction> speed);
  void set_change(std::shared_ptr<const solver::SpeedFunction> change);
  // The tent, if that is what drives the surface.
  [[nodiscard]] const solver::Tent* tent() const { return speed_.tent(); }
  [[nodiscard]] bool has_change() const { return change_.is_evaluated(); }

  // The one that a view shows; null: none, or one that shaders compute themselves.
  [[nodiscard]] SpeedPicture* of(const VolumeView& view);
  [[nodiscard]] SpeedPicture* of(const SliceView& view);

 private:
  SpeedPicture speed_;
  SpeedPicture doubt_;
  SpeedPicture change_;
};

}  // namespace tidemark::renderer
