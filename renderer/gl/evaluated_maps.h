// The maps that the processor evaluates where pictures show them: D, its doubt, and how far the surface has
// moved.
#pragma once

#include "renderer/gl/speed_picture.h"
#include "renderer/view_setup.h"

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
  [[nodiscard]] SpeedPicture* of(const VolumeView& view) { return of(map_of(view)); }
  [[nodiscard]] SpeedPicture* of(const SliceView& view) { return of(map_of(view)); }

 private:
  [[nodiscard]] SpeedPicture* of(EvaluatedMap map);

  SpeedPicture speed_;
  SpeedPicture doubt_;
  SpeedPicture change_;
};

}  // namespace tidemark::renderer
