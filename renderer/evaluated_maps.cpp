#include "renderer/evaluated_maps.h"

#include "solver/speed/doubt_map.h"

namespace tidemark::renderer {
namespace {

SpeedPicture* evaluated(SpeedPicture& map) {
  return map.is_evaluated() ? &map : nullptr;
}

}  // namespace

void EvaluatedMaps::set_speed(std::shared_ptr<const solver::SpeedFunction> speed) {
  doubt_.set_function(solver::doubt_map(speed));
  speed_.set_function(std::move(speed));
}

void EvaluatedMaps::set_change(std::shared_ptr<const solver::SpeedFunction> change) {
  change_.set_function(std::move(change));
}

SpeedPicture* EvaluatedMaps::of(const VolumeView& view) {
  switch (view.colouring) {
    case SurfaceColouring::change:
      return evaluated(change_);
    case SurfaceColouring::total_speed:
    case SurfaceColouring::data:
      return evaluated(speed_);
    default:
      return nullptr;
  }
}

SpeedPicture* EvaluatedMaps::of(const SliceView& view) {
  switch (view.content) {
    case SliceContent::source:
      return view.change ? evaluated(change_) : nullptr;
    case SliceContent::speed:
      return evaluated(view.term == SpeedTerm::doubt ? doubt_ : speed_);
    case SliceContent::pages:
      break;
  }
  return nullptr;
}

}  // namespace tidemark::renderer
