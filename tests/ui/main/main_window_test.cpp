// What the main window shows around the cases: panels, tools, help and messages.
#include <QApplication>
#include <QDialog>
#include <QDockWidget>
#include <QFileInfo>
#include <QMap>
#include <QMenuBar>
#include <QMessageBox>
#include <QPointer>
#include <QRegularExpression>
#include <QTextBrowser>
#include <QTimer>
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
  void a_session_is_among_the_recent_studies();
  void a_quit_that_was_given_up_stays_given_up_data();
  void a_quit_that_was_given_up_stays_given_up();
  void a_case_that_is_kept_at_quit_keeps_the_others();
  void a_session_is_open_once();
  void a_case_that_is_changed_while_it_is_saved_stays_open();
  void measurements_are_work_that_is_saved();

 private:
  static bool is_in_front(Desktop& desktop, const char* panel);
  static bool any_panel_shows(Desktop& desktop);
  static void close_case(Desktop& desktop);
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

void MainWindowTest::close_case(Desktop& desktop) {
  desktop.window().active_case()->close_saved();
  QVERIFY(Desktop::wait_for([&] { return desktop.window().cases().isEmpty(); }));
  QTest::qWait(50);
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
  close_case(desktop);
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
  close_case(desktop);
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
  close_case(desktop);
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
  desktop.window().active_case()->session_file = file;
  desktop.press(Qt::Key_S, Qt::ControlModifier);
  QVERIFY(Desktop::wait_for([&] { return !desktop.state().modified; }));
  for (const char* before : {"initialise", "labels", "transfer"}) {
    desktop.window().panels().show(before);
    desktop.wait_until_idle();
    QVERIFY(is_in_front(desktop, before));
    close_case(desktop);
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

void MainWindowTest::a_session_is_among_the_recent_studies() {
  Desktop desktop(solver::ExecutorKind::host);
  const TemporaryFolder folder;
  const QString file = QString::fromStdString((folder / "kept.tidemark").string());
  const auto entries = [&] {
    QList<QAction*> found;
    for (QMenu* menu : desktop.window().menuBar()->findChildren<QMenu*>()) {
      if (!menu->title().remove(u'&').contains("recent")) continue;
      for (QAction* action : menu->actions()) {
        if (action->toolTip() == file) found << action;
      }
    }
    return found;
  };
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.begin(8.0);
  QVERIFY(entries().isEmpty());
  desktop.window().active_case()->session_file = file;
  desktop.press(Qt::Key_S, Qt::ControlModifier);
  QVERIFY(Desktop::wait_for([&] { return entries().size() == 1 && !desktop.state().modified; }));
  QVERIFY(entries().front()->text().contains("kept.tidemark"));
  desktop.press(Qt::Key_W, Qt::ControlModifier);
  QVERIFY(Desktop::wait_for([&] { return desktop.window().cases().isEmpty(); }));
  entries().front()->trigger();
  QVERIFY(Desktop::wait_for([&] { return desktop.window().active_case() != nullptr; }));
  desktop.wait_until_idle();
  QVERIFY(desktop.state().begun);
  QCOMPARE(desktop.window().active_case()->session_file, file);
  QCOMPARE(entries().size(), 1);
}

void MainWindowTest::a_quit_that_was_given_up_stays_given_up_data() {
  QTest::addColumn<bool>("fails");
  QTest::newRow("one is kept open") << false;
  QTest::newRow("one cannot be saved") << true;
}

// Two cases, asked about at Quit: one is saved and closes then, one is kept. Closing that one later closes no
// more.
void MainWindowTest::a_quit_that_was_given_up_stays_given_up() {
  QFETCH(const bool, fails);
  Desktop desktop(solver::ExecutorKind::host);
  const TemporaryFolder folder;
  const auto file = folder / (fails ? "missing" : ".") / "saved.tidemark";
  QList<ui::CaseWindow*> cases;
  for (const char* kind : {"sphere", "dumbbell"}) {
    cases << desktop.open_phantom(kind);
    desktop.begin(8.0);
  }
  cases[0]->session_file = QString::fromStdString(file.string());
  const QPointer saved(cases[0]);
  const QString kept_name = cases[1]->proxy().name();
  if (fails) {
    cases[1]->close_saved();
    QVERIFY(Desktop::wait_for([&] { return desktop.window().cases().size() == 1; }));
  }
  QTimer answers;
  connect(&answers, &QTimer::timeout, [&] {
    auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
    if (!box) return;
    const bool is_kept = box->text().contains(kept_name);
    box->button(is_kept ? QMessageBox::Cancel : QMessageBox::Save)->click();
  });
  answers.start(20);
  QVERIFY(!desktop.window().close());
  answers.stop();
  const auto is_over = [&] {
    const auto* told = desktop.window().findChild<ui::MessageBar*>();
    return fails ? told->text().contains("saved.tidemark") : !saved;
  };
  QVERIFY(Desktop::wait_for(is_over));
  QCOMPARE(desktop.window().cases().size(), 1);
  for (ui::CaseWindow* window : desktop.window().cases()) window->close_saved();
  QVERIFY(Desktop::wait_for([&] { return desktop.window().cases().isEmpty(); }));
  QTest::qWait(200);
  QVERIFY(desktop.window().isVisible());
}

void MainWindowTest::a_case_that_is_kept_at_quit_keeps_the_others() {
  Desktop desktop(solver::ExecutorKind::host);
  QVERIFY(desktop.open_phantom("dumbbell"));  // without changes
  for (int n = 0; n < 2; ++n) {
    QVERIFY(desktop.open_phantom("sphere"));
    desktop.begin(8.0);
  }
  int questions = 0;
  QTimer answers;
  connect(&answers, &QTimer::timeout, [&] {
    auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
    if (!box) return;
    ++questions;
    box->button(QMessageBox::Cancel)->click();
  });
  answers.start(20);
  QVERIFY(!desktop.window().close());
  answers.stop();
  QCOMPARE(questions, 1);
  QTest::qWait(50);
  QCOMPARE(desktop.window().cases().size(), 3);
}

void MainWindowTest::a_session_is_open_once() {
  const TemporaryFolder folder;
  const QString file = QString::fromStdString((folder / "one.tidemark").string());
  Desktop desktop(solver::ExecutorKind::host);
  ui::CaseWindow* first = desktop.open_phantom("sphere");
  desktop.begin(10.0);
  first->session_file = file;
  desktop.press(Qt::Key_S, Qt::ControlModifier);
  QVERIFY(Desktop::wait_for([&] { return !first->proxy().state().modified; }));
  QVERIFY(desktop.open_phantom("dumbbell"));
  const std::filesystem::path link = folder / "link.tidemark";
  std::filesystem::create_symlink(folder / "one.tidemark", link);
  desktop.window().open(QString::fromStdString(link.string()));
  QVERIFY(Desktop::wait_for([&] { return desktop.window().active_case() == first; }));
  desktop.wait_until_idle();
  QCOMPARE(desktop.window().cases().size(), 2);
}

void MainWindowTest::a_case_that_is_changed_while_it_is_saved_stays_open() {
  const TemporaryFolder folder;
  const QString file = QString::fromStdString((folder / "one.tidemark").string());
  Desktop desktop(solver::ExecutorKind::host);
  const QPointer window(desktop.open_phantom("sphere"));
  desktop.begin(10.0);
  window->session_file = file;
  Desktop::answer(QMessageBox::Save);
  desktop.press(Qt::Key_W, Qt::ControlModifier);
  window->proxy().add_label("changed");
  QVERIFY(Desktop::wait_for([&] { return QFileInfo::exists(file); }));
  desktop.wait_until_idle();
  QTest::qWait(100);
  QVERIFY(window);
  QVERIFY(window->proxy().state().modified);
  const auto* told = desktop.window().findChild<ui::MessageBar*>();
  QVERIFY2(told->text().contains("stays open"), qPrintable(told->text()));
  Desktop::answer(QMessageBox::Save);
  desktop.press(Qt::Key_W, Qt::ControlModifier);
  QVERIFY(Desktop::wait_for([&] { return !window; }));
}

void MainWindowTest::measurements_are_work_that_is_saved() {
  const TemporaryFolder folder;
  const QString file = QString::fromStdString((folder / "one.tidemark").string());
  Desktop desktop(solver::ExecutorKind::host);
  QVERIFY(desktop.open_phantom("sphere"));
  QVERIFY(!desktop.state().modified);
  const auto measure = [&](const glm::dvec3& end) {
    desktop.proxy().display().change([&](engine::DisplaySettings& settings) {
      settings.measurements = {{engine::Measurement::Kind::distance, {glm::dvec3(0.0), end}}};
    });
  };
  measure(glm::dvec3(5.0));
  QVERIFY(desktop.state().modified);
  desktop.window().active_case()->session_file = file;
  desktop.press(Qt::Key_S, Qt::ControlModifier);
  QVERIFY(Desktop::wait_for([&] { return !desktop.state().modified; }));
  close_case(desktop);
  QVERIFY(desktop.open(file));
  QCOMPARE(desktop.proxy().display().settings().measurements.size(), std::size_t{1});
  QVERIFY(!desktop.state().modified);
  measure(glm::dvec3(6.0));
  QVERIFY(desktop.state().modified);
}

TIDEMARK_TEST(MainWindowTest)

}  // namespace tidemark::test::main_window_test

#include "main_window_test.moc"
