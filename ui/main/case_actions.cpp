#include "ui/main/case_actions.h"

#include "engine/case_balance.h"
#include "ui/main/case_comparison.h"
#include "ui/main/case_exports.h"
#include "ui/main/film_writer.h"
#include "ui/main/main_window.h"
#include "ui/main/panel_docks.h"
#include "ui/main/session_writer.h"
#include "ui/views/play.h"

namespace tidemark::ui {
namespace {

template <class Act>
void with_case(MainWindow& main, QAction* action, Act act) {
  QObject::connect(action, &QAction::triggered, &main, [&main, act] {
    if (CaseWindow* active = main.active_case()) act(*active);
  });
}

// Turns a setting of the display on or off.
void toggles(MainWindow& main, QAction* action, bool engine::DisplaySettings::*setting) {
  with_case(main, action, [setting](CaseWindow& window) {
    window.proxy().display().change(
        [setting](engine::DisplaySettings& settings) { settings.*setting = !(settings.*setting); });
  });
}

void connect_files(MainWindow& main) {
  const Actions& actions = main.actions();
  with_case(main, actions.save, [&main](CaseWindow& window) { main.session_writer().save(window); });
  with_case(main, actions.save_as, [&main](CaseWindow& window) { main.session_writer().save_as(window); });
  with_case(main, actions.export_mask, [&main](CaseWindow& window) { main.exports().export_mask(window); });
  with_case(main, actions.export_mesh, [&main](CaseWindow& window) { main.exports().export_mesh(window); });
  with_case(main, actions.export_picture,
            [&main](CaseWindow& window) { main.exports().export_picture(window); });
  with_case(main, actions.export_film, [&main](CaseWindow& window) { main.films().ask_and_write(window); });
  with_case(main, actions.export_statistics,
            [&main](CaseWindow& window) { main.exports().export_statistics(window); });
  with_case(main, actions.export_report,
            [&main](CaseWindow& window) { main.exports().export_report(window); });
  with_case(main, actions.export_recipe,
            [&main](CaseWindow& window) { main.exports().export_recipe(window); });
  // The MDI area knows of no active window while a panel or a dialog has the keyboard.
  with_case(main, actions.close, [](CaseWindow& window) { window.parentWidget()->close(); });
}

void connect_evolution(MainWindow& main) {
  const Actions& actions = main.actions();
  with_case(main, actions.play, [](CaseWindow& window) { toggle_play(window.proxy()); });
  with_case(main, actions.step, [](CaseWindow& window) { window.proxy().step(); });
  with_case(main, actions.step_back, [](CaseWindow& window) { window.proxy().step_back(); });
  with_case(main, actions.restart, [](CaseWindow& window) { window.proxy().restart(); });
  with_case(main, actions.fastest_place, [](CaseWindow& window) { window.proxy().balance().ask_fastest(); });
  with_case(main, actions.undo, [](CaseWindow& window) { window.proxy().undo(); });
  with_case(main, actions.redo, [](CaseWindow& window) { window.proxy().redo(); });
  with_case(main, actions.last_tool, [](CaseWindow& window) {
    window.proxy().display().choose_tool(window.proxy().display().settings().last_tool);
  });
  QObject::connect(actions.tools, &QActionGroup::triggered, &main, [&main](QAction* chosen) {
    for (CaseWindow* window : main.cases())
      window->proxy().display().choose_tool(static_cast<engine::Tool>(chosen->data().toInt()));
  });
  QObject::connect(actions.passes, &QAction::triggered, &main, [&main] { main.panels().show("passes"); });
}

void connect_views(MainWindow& main) {
  const Actions& actions = main.actions();
  QObject::connect(actions.layouts, &QActionGroup::triggered, &main, [&main](QAction* chosen) {
    if (CaseWindow* active = main.active_case())
      active->set_layout(static_cast<ViewLayout>(chosen->data().toInt()));
  });
  with_case(main, actions.reset_view, [](CaseWindow& window) { window.reset_views(); });
  toggles(main, actions.forces, &engine::DisplaySettings::forces);
  toggles(main, actions.clip, &engine::DisplaySettings::clip_on);
  toggles(main, actions.swipe, &engine::DisplaySettings::swipe);
  toggles(main, actions.patient_text, &engine::DisplaySettings::patient_text);
}

void connect_comparison(MainWindow& main) {
  const Actions& actions = main.actions();
  with_case(main, actions.duplicate_case,
            [&main](CaseWindow& window) { main.comparison().duplicate(window); });
  with_case(main, actions.compare_schemes,
            [&main](CaseWindow& window) { main.comparison().compare_schemes(window); });
}

}  // namespace

void connect_case_actions(MainWindow& window) {
  connect_files(window);
  connect_evolution(window);
  connect_views(window);
  connect_comparison(window);
}

}  // namespace tidemark::ui
