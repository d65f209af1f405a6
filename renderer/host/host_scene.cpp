#include "renderer/host/host_scene.h"

namespace tidemark::renderer {

HostScene::HostScene(std::shared_ptr<const Volume> volume, const PageLayout& layout)
    : source(std::move(volume)),
      phi(layout, solver::default_band(geometry())),
      labels(layout),
      speed(geometry().size),
      doubt(geometry().size),
      change(geometry().size),
      opacity(layout) {}

MapSamples* HostScene::map(EvaluatedMap which) {
  MapSamples* map = which == EvaluatedMap::speed    ? &speed
                    : which == EvaluatedMap::doubt  ? &doubt
                    : which == EvaluatedMap::change ? &change
                                                    : nullptr;
  return map != nullptr && map->is_evaluated() ? map : nullptr;
}

}  // namespace tidemark::renderer
