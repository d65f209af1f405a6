// What the main window shows around the cases: panels, tools, help and messages.
#include <QDialog>
#include <QDockWidget>
#include <QLocale>
#include <QTextBrowser>
#include <algorithm>
#include <glm/geometric.hpp>

#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "tests/ui/main/window_checks.h"
#include "ui/main/case_exports.h"
#include "ui/main/message_bar.h"
#include "ui/main/panel_docks.h"

namespace tidemark::test::main_window_test {

class MainWindowTest : public QObject {
  Q_OBJECT

 private slots:
  void panels_come_and_go_with_the_cases();
  void hidden_panels_stay_hidden_for_the_next_case();
  void how_panels_stand_is_remembered_though_none_shows_at_the_end();
  void without_a_case_nothing_is_chosen_or_playing();
  void help_is_one_window_and_escape_closes_it();
  void a_session_that_is_opened_shows_the_level_set();
  void a_failure_is_forgotten_once_it_has_succeeded();
  void a_phantom_has_one_name();
  void the_left_button_moves_the_crosshair_as_in_itk_snap_if_one_wants();
  void full_screen_gives_back_a_maximised_window();
  void full_screen_of_the_last_time_is_left_by_its_key();
  void no_menu_has_a_letter_twice();
  void numbers_are_typed_with_either_separator_in_any_language();

 private:
  static bool is_in_front(Desktop& desktop, const char* panel);
  static bool any_panel_shows(Desktop& desktop);
};

bool MainWindowTest::is_in_front(Desktop& desktop, const char* panel) {
  const auto* dock = desktop.window().findChild<QDockWidget*>(panel);
  return dock && !dock->visibleRegion().isEmpty();
}

bool MainWindowTest::any_panel_shows(Desktop& desktop) {
  const QList<QDockWidget*> docks =
      desktop.window().findChildren<QDockWidget*>(QString(), Qt::FindDirectChildrenOnly);
  return std::any_of(docks.begin(), docks.end(), [](const QDockWidget* dock) { return dock->isVisible(); });
}

void MainWindowTest::panels_come_and_go_with_the_cases() {
  Desktop desktop(solver::ExecutorKind::host, {1100, 700});
  QVERIFY(!any_panel_shows(desktop));
  for (QAction* toggle : desktop.window().panels().toggles()) QVERIFY(!toggle->isEnabled());
  QVERIFY(desktop.open_phantom("sphere"));
  QVERIFY(is_in_front(desktop, "initialise"));
  for (QAction* toggle : desktop.window().panels().toggles()) QVERIFY(toggle->isEnabled());
  QCOMPARE(desktop.window().findChild<QDockWidget*>("initialise")->width(), 320);
  desktop.window().panels().show("labels");
  desktop.wait_until_idle();
  desktop.close_case();
  QVERIFY(!any_panel_shows(desktop));
  // As they stood.
  QVERIFY(desktop.open_phantom("sphere"));
  QVERIFY(is_in_front(desktop, "labels"));
  QCOMPARE(desktop.window().findChild<QDockWidget*>("labels")->width(), 320);
}

void MainWindowTest::hidden_panels_stay_hidden_for_the_next_case() {
  Desktop desktop(solver::ExecutorKind::host, {1100, 700});
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.press(Qt::Key_F3);
  QVERIFY(!any_panel_shows(desktop));
  desktop.close_case();
  QVERIFY(desktop.open_phantom("sphere"));
  QVERIFY(!any_panel_shows(desktop));
  desktop.press(Qt::Key_F3);
  desktop.wait_until_idle();
  QVERIFY(is_in_front(desktop, "initialise"));
}

void MainWindowTest::how_panels_stand_is_remembered_though_none_shows_at_the_end() {
  Desktop desktop(solver::ExecutorKind::host, {1100, 700});
  for (const bool first : {true, false}) {
    ui::MainWindow window(desktop.engine());
    window.resize(1100, 700);
    window.show();
    QVERIFY(QTest::qWaitForWindowExposed(&window));
    window.open_phantom("sphere");
    QVERIFY(Desktop::wait_for([&] { return window.active_case() != nullptr; }));
    desktop.wait_until_idle();
    if (first) {
      window.panels().show("display");
      QTest::qWait(50);
    }
    const auto* display = window.findChild<QDockWidget*>("display");
    QVERIFY(display->isVisible() && !display->visibleRegion().isEmpty());
    window.active_case()->close_saved();
    QVERIFY(window.close());
  }
}

void MainWindowTest::without_a_case_nothing_is_chosen_or_playing() {
  Desktop desktop(solver::ExecutorKind::host, {1100, 700});
  ui::Actions& actions = desktop.window().actions();
  QVERIFY(!actions.tools->checkedAction());
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.press(Qt::Key_B);
  QCOMPARE(actions.tools->checkedAction(), actions.tool(engine::Tool::paint));
  desktop.press(Qt::Key_X);
  desktop.begin(10.0);
  desktop.proxy().set_pause_at_convergence(false);
  desktop.press(Qt::Key_P);
  QVERIFY(Desktop::wait_for([&] { return desktop.state().playing; }));
  QVERIFY(actions.play->isChecked());
  desktop.close_case();
  QVERIFY(!actions.tools->checkedAction());
  QVERIFY(!actions.play->isChecked() && !actions.clip->isChecked());
  QCOMPARE(actions.play->text(), QString("&Play"));
  QCOMPARE(actions.undo->text(), QString("&Undo"));
  // The group still lets only one be chosen.
  QVERIFY(desktop.open_phantom("sphere"));
  QVERIFY(actions.tools->checkedAction());
  actions.tool(engine::Tool::erase)->trigger();
  QCOMPARE(actions.tools->checkedAction(), actions.tool(engine::Tool::erase));
}

void MainWindowTest::help_is_one_window_and_escape_closes_it() {
  Desktop desktop(solver::ExecutorKind::host, {1100, 700});
  const auto pages = [&] {
    QList<QDialog*> visible;
    for (QDialog* dialog : desktop.window().findChildren<QDialog*>()) {
      if (dialog->isVisible()) visible << dialog;
    }
    return visible;
  };
  for (int press = 0; press < 2; ++press) {
    desktop.press(Qt::Key_F1, Qt::ShiftModifier);
    QCOMPARE(pages().size(), 1);
  }
  QDialog* page = pages().first();
  QVERIFY(QTest::qWaitForWindowActive(page));
  QTest::keyClick(page->findChild<QTextBrowser*>(), Qt::Key_Escape);
  QVERIFY(pages().isEmpty());
  // With the keys as they are by then.
  ui::Actions& actions = desktop.window().actions();
  actions.set_key(actions.play, QKeySequence("F7"));
  desktop.press(Qt::Key_F1, Qt::ShiftModifier);
  QCOMPARE(pages().size(), 1);
  QVERIFY(pages().first()->findChild<QTextBrowser*>()->toPlainText().contains("F7"));
}

void MainWindowTest::a_session_that_is_opened_shows_the_level_set() {
  const TemporaryFolder folder;
  const QString file = QString::fromStdString((folder / "one.tidemark").string());
  Desktop desktop(solver::ExecutorKind::host, {1100, 700});
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.begin(10.0);
  QVERIFY(desktop.save_session(file));
  for (const char* before : {"initialise", "labels", "transfer"}) {
    desktop.window().panels().show(before);
    desktop.wait_until_idle();
    QVERIFY(is_in_front(desktop, before));
    desktop.close_case();
    QVERIFY(desktop.open(file));
    QVERIFY2(is_in_front(desktop, "level-set"), before);
  }
}

void MainWindowTest::a_failure_is_forgotten_once_it_has_succeeded() {
  const TemporaryFolder folder;
  const auto inside = [&](const char* name) { return QString::fromStdString((folder / name).string()); };
  Desktop desktop(solver::ExecutorKind::host, {1100, 700});
  const auto* messages = desktop.window().findChild<ui::MessageBar*>();
  const auto told = [&] { return Desktop::wait_for([&] { return !messages->text().isEmpty(); }); };
  const auto forgotten = [&] { return Desktop::wait_for([&] { return messages->text().isEmpty(); }); };

  // Opening.
  desktop.window().open(inside("nowhere"));
  QVERIFY(told());
  QVERIFY(desktop.open_phantom("sphere"));
  QVERIFY(forgotten());
  desktop.begin(10.0);

  // Writing: what goes elsewhere or is another kind of file changes nothing.
  ui::CaseWindow& window = *desktop.window().active_case();
  ui::CaseExports& saved = desktop.window().exports();
  saved.write_mask(window, inside("missing/mask.nrrd"));
  QVERIFY(told());
  const QString message = messages->text();
  saved.write_surface(window, inside("surface.stl"));
  QVERIFY(Desktop::wait_for([&] { return std::filesystem::exists(folder / "surface.stl"); }));
  desktop.wait_until_idle();
  QCOMPARE(messages->text(), message);
  saved.write_mask(window, inside("mask.nrrd"));
  QVERIFY(forgotten());
  saved.write_statistics(window, inside("missing/figures.csv"));
  QVERIFY(told());
  saved.write_statistics(window, inside("figures.csv"));
  QVERIFY(forgotten());
  QVERIFY(std::filesystem::exists(folder / "figures.csv"));

  // The case itself.
  desktop.proxy().begin_from_label(77);
  QVERIFY(told());
  desktop.wait_until_idle();
  QVERIFY(!messages->text().isEmpty());
  desktop.proxy().paint({desktop.seed_mm(), 12.0}, solver::Brush::add, engine::CaseProxy::new_gesture());
  QVERIFY(forgotten());
}

void MainWindowTest::a_phantom_has_one_name() {
  Desktop desktop(solver::ExecutorKind::host, {1100, 700});
  QVERIFY(desktop.open_phantom("organ"));
  QCOMPARE(desktop.proxy().name(), QString("Liver"));
  QVERIFY(desktop.window().active_case()->windowTitle().startsWith("Liver[*]"));
}

void MainWindowTest::the_left_button_moves_the_crosshair_as_in_itk_snap_if_one_wants() {
  Desktop desktop(solver::ExecutorKind::host, {1100, 700});
  QVERIFY(desktop.open_phantom("sphere"));
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  QVERIFY(axial);
  const auto settings = [&] { return desktop.proxy().display().settings(); };
  ui::Actions& actions = desktop.window().actions();
  actions.tool(engine::Tool::window)->trigger();
  const engine::DisplaySettings before = settings();
  const glm::dvec3 there = before.cursor_mm + glm::dvec3(12.0, 6.0, 0.0);
  const std::vector<glm::dvec3> way{before.cursor_mm + glm::dvec3(5.0, 0.0, 0.0), there};

  const QList<QAction*> schemes = actions.mouse_schemes->actions();
  QVERIFY(schemes.first()->isChecked());
  schemes.last()->trigger();
  Desktop::drag(*axial, way);
  QVERIFY(settings().window == before.window);
  QVERIFY(glm::distance(settings().cursor_mm, there) < 2.0);
  Desktop::drag(*axial, way, Qt::LeftButton, Qt::AltModifier);
  QVERIFY(settings().window != before.window);
  QVERIFY(ui::Actions(&desktop.window()).mouse_schemes->actions().last()->isChecked());  // the next time, too

  const engine::DisplaySettings moved = settings();
  schemes.first()->trigger();
  Desktop::drag(*axial, way);
  QVERIFY(settings().window != moved.window);
  QVERIFY(settings().cursor_mm == moved.cursor_mm);
}

void MainWindowTest::full_screen_gives_back_a_maximised_window() {
  Desktop desktop(solver::ExecutorKind::host);
  ui::MainWindow& window = desktop.window();
  for (const bool maximised : {true, false}) {
    maximised ? window.showMaximized() : window.showNormal();
    QVERIFY(Desktop::wait_for([&] { return window.isMaximized() == maximised; }));
    desktop.press(Qt::Key_F11);
    QVERIFY(Desktop::wait_for([&] { return window.isFullScreen(); }));
    desktop.press(Qt::Key_F11);
    QVERIFY(Desktop::wait_for([&] { return !window.isFullScreen(); }));
    QCOMPARE(window.isMaximized(), maximised);
  }
}

void MainWindowTest::full_screen_of_the_last_time_is_left_by_its_key() {
  Desktop desktop(solver::ExecutorKind::host);
  for (const bool begins_full : {false, true}) {
    ui::MainWindow window(desktop.engine());
    window.show();
    QVERIFY(QTest::qWaitForWindowExposed(&window));
    const QAction& full_screen = *window.actions().full_screen;
    QCOMPARE(window.isFullScreen(), begins_full);
    QCOMPARE(full_screen.isChecked(), begins_full);
    window.activateWindow();
    QVERIFY(QTest::qWaitForWindowActive(&window));
    QTest::keyClick(&window, Qt::Key_F11);
    QVERIFY(Desktop::wait_for([&] { return window.isFullScreen() != begins_full; }));
    QCOMPARE(full_screen.isChecked(), !begins_full);
    QVERIFY(window.close());
  }
}

void MainWindowTest::no_menu_has_a_letter_twice() {
  Desktop desktop(solver::ExecutorKind::host);
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.begin(8.0);
  QCOMPARE(doubled_menu_letters(desktop.window()).join("; "), QString());
}

void MainWindowTest::numbers_are_typed_with_either_separator_in_any_language() {
  for (const char* language : {"de_DE", "en_US"}) {
    QLocale::setDefault(QLocale(language));
    Desktop desktop(solver::ExecutorKind::host);
    QVERIFY(desktop.open_phantom("dumbbell"));
    desktop.begin(8.0);
    desktop.window().panels().show("level-set");
    for (const char* range : {"97.5", "96,5"}) {
      desktop.type_into("Range ε", range);
      QCOMPARE(desktop.state().parameters.range, QString(range).replace(',', '.').toDouble());
    }
    for (const char* alpha : {"0.25", "0,75"}) {
      desktop.type_into("Data weight α", alpha);
      QCOMPARE(desktop.state().parameters.alpha, QString(alpha).replace(',', '.').toDouble());
    }
    desktop.type_into("Range epsilon", "88.5");  // in the bar over a view
    QCOMPARE(desktop.state().parameters.range, 88.5);
    desktop.type_into("Range ε", "1.234,5");
    QCOMPARE(desktop.state().parameters.range, 88.5);
    desktop.screenshot(QStringLiteral("refused-number-%1").arg(language));
  }
  QLocale::setDefault(QLocale::c());
}

TIDEMARK_TEST(MainWindowTest)

}  // namespace tidemark::test::main_window_test

#include "main_window_test.moc"
