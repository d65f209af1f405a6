#include "ui/main/case_links.h"

#include <QScopedValueRollback>
#include <algorithm>
#include <utility>
#include <vector>

#include "ui/main/parameter_difference.h"

namespace tidemark::ui {
namespace {

// Whether a window of one shows the same tissues in the other. Of unknown modalities only a study itself is
// known to be alike.
bool have_same_values(const engine::CaseProxy& a, const engine::CaseProxy& b) {
  if (a.volume().modality.empty()) {
    return a.study().origin.path == b.study().origin.path &&
           a.study().origin.series_uid == b.study().origin.series_uid;
  }
  return a.volume().modality == b.volume().modality && a.volume().unit == b.volume().unit;
}

}  // namespace

void CaseLinks::link(const QList<CaseWindow*>& windows) {
  for (CaseWindow* window : std::exchange(windows_, {})) {
    window->disconnect(this);
    window->proxy().disconnect(this);
    window->proxy().display().disconnect(this);
    window->set_linked(false);
    window->set_difference({});
  }
  if (windows.size() > 1) {
    for (CaseWindow* window : windows) {
      windows_ << window;
      window->set_linked(true);
      connect(&window->proxy().display(), &engine::Display::changed, this,
              [this, window] { follow(*window); });
      connect(&window->proxy(), &engine::CaseProxy::state_changed, this, &CaseLinks::show_differences);
      connect(window, &QObject::destroyed, this, [this, window] { forget(window); });
    }
    follow(*windows_.first());
    show_differences();
  }
  emit changed();
}

void CaseLinks::show_differences() {
  std::vector<solver::Parameters> parameters;
  for (CaseWindow* window : windows_) parameters.push_back(window->proxy().parameters());
  const QStringList texts = parameter_differences(parameters);
  for (qsizetype i = 0; i < windows_.size(); ++i) windows_[i]->set_difference(texts[i]);
}

void CaseLinks::play_together(const QList<CaseWindow*>& windows, bool together) {
  std::vector<engine::CaseProxy*> proxies;
  for (CaseWindow* window : windows) {
    if (!together && window->proxy().in_lock_step()) window->proxy().leave_lock_step();
    proxies.push_back(&window->proxy());
  }
  if (together && proxies.size() > 1) engine::CaseProxy::play_in_lock_step(proxies);
  emit changed();
}

bool CaseLinks::any_in_lock_step(const QList<CaseWindow*>& windows) {
  const auto is_in = [](CaseWindow* window) { return window->proxy().in_lock_step(); };
  return std::count_if(windows.begin(), windows.end(), is_in) > 1;
}

void CaseLinks::forget(CaseWindow* closed) {
  windows_.removeAll(closed);
  if (windows_.size() < 2) return unlink();
  show_differences();
}

void CaseLinks::follow(CaseWindow& moved) {
  if (following_) return;
  const QScopedValueRollback guard(following_, true);
  const engine::DisplaySettings& from = moved.proxy().display().settings();
  for (CaseWindow* window : windows_) {
    if (window == &moved) continue;
    const bool same_values = have_same_values(window->proxy(), moved.proxy());
    window->proxy().display().change([&](engine::DisplaySettings& to) {
      // Beside a study, which may be another patient's, there is nothing of it to see.
      const Geometry& grid = window->proxy().volume().geometry;
      if (grid.covers(from.cursor_mm)) to.cursor_mm = from.cursor_mm;
      if (grid.covers(from.slice_centre_mm)) to.slice_centre_mm = from.slice_centre_mm;
      to.slice_zoom = from.slice_zoom;
      to.oblique = from.oblique;
      if (same_values) to.window = from.window;
      const auto focus_mm = to.camera.focus_mm;
      to.camera = from.camera;
      if (to.camera.focus_mm && !grid.covers(*to.camera.focus_mm)) to.camera.focus_mm = focus_mm;
      to.clip_on = from.clip_on;
      to.clip = from.clip;
    });
  }
}

}  // namespace tidemark::ui
