#include "ui/main/view_menu.h"

#include <QMenu>
#include <algorithm>
#include <glm/common.hpp>

#include "engine/case_balance.h"
#include "ui/look/icons.h"
#include "ui/main/actions.h"
#include "ui/panels/window_presets.h"
#include "ui/views/picture_view.h"
#include "ui/views/probe_drags.h"
#include "ui/widgets/menu_text.h"
#include "ui/widgets/tr.h"

namespace tidemark::ui {
namespace {

// The case may be gone before the menu is; its views are gone then, too.
void add_place(QMenu& menu, PictureView& view, std::optional<glm::dvec3> place_mm) {
  const auto add = [&](const char* picture, const QString& text, auto act) {
    QAction* action = menu.addAction(icon(QString::fromLatin1(picture)), text);
    action->setEnabled(place_mm.has_value());
    if (!place_mm) return;
    QObject::connect(action, &QAction::triggered, &view,
                     [&proxy = view.proxy(), place = *place_mm, act] { act(proxy, place); });
  };
  add("tool-crosshair", tr("&Show this place in all views"), [](engine::CaseProxy& proxy, glm::dvec3 place) {
    proxy.display().change([&](engine::DisplaySettings& settings) { settings.cursor_mm = place; });
  });
  add("tool-seed", tr("&Place a sphere here"), [](engine::CaseProxy& proxy, glm::dvec3 place) {
    proxy.paint({place, proxy.display().settings().brush_mm}, solver::Brush::add,
                engine::CaseProxy::new_gesture());
  });
  add("tool-probe", tr("Probe &T and ε here"), probe_speed_at);
  add("tool-why", tr("Wh&y does it move or rest here?"),
      [](engine::CaseProxy& proxy, glm::dvec3 place) { proxy.balance().ask(place); });
}

// Null: no label is there.
const document::Label* label_at(const engine::CaseProxy& proxy, glm::dvec3 place_mm) {
  const engine::CaseState& state = proxy.state();
  const Geometry& grid = proxy.volume().geometry;
  const Index3 voxel(glm::round(grid.to_voxel(place_mm)));
  if (!state.label_voxels || !grid.contains(voxel)) return nullptr;
  const std::uint8_t id = state.label_voxels->at(voxel);
  const auto label = std::find_if(state.labels.begin(), state.labels.end(),
                                  [&](const document::Label& one) { return one.id == id; });
  return label == state.labels.end() ? nullptr : &*label;
}

void add_label(QMenu& menu, PictureView& view, std::optional<glm::dvec3> place_mm) {
  const document::Label* label = place_mm ? label_at(view.proxy(), *place_mm) : nullptr;
  QAction* action = menu.addAction(
      icon(u"label"), label ? tr("Choose the &label “%1”").arg(menu_text(QString::fromStdString(label->name)))
                            : tr("Choose the &label here"));
  action->setEnabled(label != nullptr);
  if (!label) return;
  QObject::connect(action, &QAction::triggered, &view,
                   [&proxy = view.proxy(), id = label->id] { proxy.display().choose_label(id); });
}

void add_windows(QMenu& menu, PictureView& view) {
  QMenu* windows = menu.addMenu(icon(u"tool-window"), tr("&Window and level"));
  engine::CaseProxy& proxy = view.proxy();
  for (const WindowPreset& preset : window_presets(proxy.volume(), proxy.summary())) {
    QObject::connect(
        windows->addAction(preset.name), &QAction::triggered, &view, [&proxy, window = preset.window] {
          proxy.display().change([&](engine::DisplaySettings& settings) { settings.window = window; });
        });
  }
}

void add_overlays(QMenu& menu, PictureView& view, const Actions& actions) {
  QMenu* overlays = menu.addMenu(icon(u"eye"), tr("&Overlays"));
  const auto add = [&](const QString& text, bool engine::DisplaySettings::*setting) {
    QAction* action = overlays->addAction(text);
    action->setCheckable(true);
    action->setChecked(view.proxy().display().settings().*setting);
    QObject::connect(action, &QAction::triggered, &view, [&proxy = view.proxy(), setting](bool on) {
      proxy.display().change([=](engine::DisplaySettings& settings) { settings.*setting = on; });
    });
  };
  add(tr("&Outline of the surface"), &engine::DisplaySettings::outline);
  add(tr("&Crosshair"), &engine::DisplaySettings::crosshair);
  add(tr("&Arrows of the terms"), &engine::DisplaySettings::forces);
  add(tr("&Examples, walls and anchors"), &engine::DisplaySettings::marks);
  if (view.proxy().truth()) {
    add(tr("Outline of the t&ruth"), &engine::DisplaySettings::truth);
    add(tr("&Distances to the truth"), &engine::DisplaySettings::truth_error);
  }
  overlays->addAction(actions.patient_text);
}

}  // namespace

QMenu* make_view_menu(PictureView& view, const Actions& actions, std::optional<glm::dvec3> place_mm) {
  auto* menu = new QMenu(&view);
  menu->setAttribute(Qt::WA_DeleteOnClose);
  add_place(*menu, view, place_mm);
  add_label(*menu, view, place_mm);
  menu->addSeparator();
  add_windows(*menu, view);
  add_overlays(*menu, view, actions);
  menu->addSeparator();
  QObject::connect(menu->addAction(icon(u"maximise"), tr("&Large, or back")), &QAction::triggered, &view,
                   &PictureView::maximise_wanted);
  menu->addActions({actions.reset_view, actions.export_picture, actions.export_film});
  return menu;
}

}  // namespace tidemark::ui
