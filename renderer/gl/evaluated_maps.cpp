#include "renderer/gl/evaluated_maps.h"

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

SpeedPicture* EvaluatedMaps::of(EvaluatedMap map) {
  switch (map) {
    case EvaluatedMap::speed:
      return evaluated(speed_);
    case EvaluatedMap::doubt:
      return evaluated(doubt_);
    case EvaluatedMap::change:
      return evaluated(change_);
    case EvaluatedMap::none:
      break;
  }
  return nullptr;
}

}  // namespace tidemark::renderer
