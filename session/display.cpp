#include "session/display.h"

namespace tidemark {

void Display::set(DisplaySettings next) {
  if (next == settings_) return;
  settings_ = std::move(next);
  emit changed();
}

void Display::choose_tool(Tool tool) {
  change([&](DisplaySettings& settings) {
    if (settings.tool == tool) return;
    settings.last_tool = settings.tool;
    settings.tool = tool;
  });
}

}  // namespace tidemark
