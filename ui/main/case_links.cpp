#include "ui/main/case_links.h"

#include <QScopedValueRollback>

namespace tidemark {

void CaseLinks::add(CaseWindow& window) {
  windows_ << &window;
  connect(&window.session().display(), &Display::changed, this, [this, moved = QPointer(&window)] {
    if (moved) follow(*moved);
  });
}

void CaseLinks::set_linked(bool linked) {
  linked_ = linked;
  for (const auto& window : windows_) {
    if (!linked_ || !window) continue;
    follow(*window);  // the first one leads
    return;
  }
}

void CaseLinks::follow(CaseWindow& moved) {
  if (!linked_ || following_) return;
  const QScopedValueRollback guard(following_, true);
  const DisplaySettings& from = moved.session().display().settings();
  for (const auto& window : windows_) {
    if (!window || window == &moved) continue;
    window->session().display().change([&](DisplaySettings& to) {
      to.cursor_mm = from.cursor_mm;
      to.slice_centre_mm = from.slice_centre_mm;
      to.slice_zoom = from.slice_zoom;
      to.oblique = from.oblique;
      to.window = from.window;
      to.camera = from.camera;
      to.clip_on = from.clip_on;
      to.clip = from.clip;
    });
  }
}

}  // namespace tidemark
