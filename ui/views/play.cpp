#include "ui/views/play.h"

#include "engine/stroke_painting.h"

namespace tidemark::ui {

bool can_play(const engine::CaseProxy& proxy) {
  return proxy.state().begun || engine::can_teach(proxy.drive().strokes.get());
}

void toggle_play(engine::CaseProxy& proxy) {
  if (!can_play(proxy)) return;
  if (!proxy.state().begun) proxy.begin(engine::start_in(proxy.volume().geometry, *proxy.drive().strokes));
  proxy.toggle_play();
}

}  // namespace tidemark::ui
