// A sweep is run, looked at and taken from, by mouse and keys.
#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QPushButton>

#include "document/sweep_picture.h"
#include "engine/case_sweep.h"
#include "solver/inside_region.h"
#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "ui/main/panel_docks.h"
#include "ui/panels/sweep_matrix.h"
#include "ui/panels/sweep_panel.h"
#include "ui/widgets/number_box.h"

namespace tidemark::test::sweep_story_test {

class SweepStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void a_run_is_taken_and_undone();
  void what_the_runs_agree_on_shows_on_the_slices();
  void what_the_runs_agree_on_shows_on_the_surface();
  void a_sweep_is_given_up();
  void each_case_has_its_own_sweep();
  void an_arrangement_from_before_the_panel_still_opens();

 private:
  static ui::SweepPanel* shown_panel(Desktop& desktop) {
    desktop.window().panels().show("sweep");
    auto* panel = desktop.window().findChild<ui::SweepPanel*>();
    if (!Desktop::wait_for([&] { return panel->isVisible(); })) qFatal("there is no panel");
    desktop.wait_until_idle();
    return panel;
  }
  template <class Widget>
  static Widget* named(QWidget& in, const QString& name) {
    for (Widget* widget : in.findChildren<Widget*>()) {
      if (widget->accessibleName() == name) return widget;
    }
    qFatal("no %s", qPrintable(name));
  }
  static void type(QAbstractSpinBox* box, const QString& text) {
    QTest::mouseClick(box, Qt::LeftButton);
    box->selectAll();
    QTest::keyClicks(box, text);
    QTest::keyClick(box, Qt::Key_Tab);
  }
  // As many values as that of either parameter.
  static void choose_counts(ui::SweepPanel& panel, int across, int down) {
    type(named<ui::NumberBox>(panel, "Across: number of values"), QString::number(across));
    type(named<ui::NumberBox>(panel, "Down: number of values"), QString::number(down));
  }
  static QCheckBox* shown_check(QWidget& in, const QString& text) {
    for (QCheckBox* check : in.findChildren<QCheckBox*>()) {
      if (check->text() == text && check->isVisible()) return check;
    }
    qFatal("no %s", qPrintable(text));
  }
  static void click(QCheckBox& check) {
    QTest::mouseClick(&check, Qt::LeftButton, {}, {8, check.height() / 2});
  }
  // Of the pixels of a view's picture, those that `is` says.
  template <class Is>
  static int count_of(ui::PictureView& view, Is is) {
    const QImage picture = view.grab_picture();
    int count = 0;
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) count += is(picture.pixelColor(x, y)) ? 1 : 0;
    }
    return count;
  }
  static QPushButton* run_button(ui::SweepPanel& panel) { return panel.findChild<QPushButton*>(); }
  static void run_all(Desktop& desktop, ui::SweepPanel& panel) {
    QTest::mouseClick(run_button(panel), Qt::LeftButton);
    QVERIFY(Desktop::wait_for([&] { return !desktop.proxy().sweep().running(); }, 60000));
    desktop.wait_until_idle();
    QVERIFY(desktop.proxy().sweep().outcome());
  }
  static void click_run(ui::SweepPanel& panel, QPoint cell) {
    auto* matrix = panel.findChild<ui::SweepMatrix*>();
    QVERIFY(matrix->isVisible());
    QTest::mouseClick(matrix, Qt::LeftButton, {}, matrix->picture_at(cell).center());
  }
};

void SweepStoryTest::a_run_is_taken_and_undone() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  ui::SweepPanel& panel = *shown_panel(desktop);
  QVERIFY(!run_button(panel)->isEnabled());  // there is no surface
  desktop.begin(10.0);
  desktop.window().panels().show("sweep");
  QVERIFY(Desktop::wait_for([&] { return run_button(panel)->isEnabled(); }));
  desktop.screenshot("sweep-0-before");
  const solver::Parameters before = desktop.state().parameters;

  type(named<ui::NumberBox>(panel, "Across: first value"), "0,4");  // either separator is understood
  type(named<ui::NumberBox>(panel, "Across: last value"), "0.8");
  choose_counts(panel, 3, 2);
  run_all(desktop, panel);
  const auto outcome = desktop.proxy().sweep().outcome();
  QCOMPARE(outcome->sweep.columns(), 3);
  QCOMPARE(outcome->sweep.rows(), 2);
  QCOMPARE(outcome->sweep.axes.front().value(0), 0.4);
  QCOMPARE(desktop.state().step, std::int64_t{0});  // the surface stays as it is
  QCOMPARE(desktop.state().undo_text, QString("placing the surface"));
  desktop.screenshot("sweep-1-runs");

  auto* colours = named<QComboBox>(panel, "Colours");
  colours->setFocus();
  QTest::keyClick(colours, Qt::Key_Down);  // the phantom's truth is known
  QCOMPARE(colours->currentText(), QString("Dice"));
  desktop.screenshot("sweep-2-dice");

  click_run(panel, {1, 0});
  const document::SweepRun& wanted = outcome->sweep.at(1, 0);
  QVERIFY(Desktop::wait_for([&] { return desktop.state().step == wanted.steps; }));
  desktop.wait_until_idle();
  QVERIFY(desktop.state().parameters == wanted.parameters);
  QCOMPARE(desktop.state().converged, wanted.converged);
  QVERIFY(std::abs(*desktop.state().dice - *wanted.dice) < 1e-3);
  QVERIFY(std::abs(desktop.state().surface.volume_ml / wanted.volume_ml - 1.0) < 1e-3);
  if (story_executor() == solver::ExecutorKind::host) {
    QVERIFY(solver::inside_region(*desktop.state().phi) == wanted.inside);
  }
  desktop.screenshot("sweep-3-taken");
  desktop.press(Qt::Key_Z, Qt::ControlModifier);
  QVERIFY(Desktop::wait_for([&] { return desktop.state().step == 0; }));
  desktop.wait_until_idle();
  QVERIFY(desktop.state().parameters == before);
  QCOMPARE(desktop.state().undo_text, QString("placing the surface"));

  // By keys: one to the right, one down.
  auto* matrix = panel.findChild<ui::SweepMatrix*>();
  matrix->setFocus();
  for (const Qt::Key key : {Qt::Key_Right, Qt::Key_Down, Qt::Key_Return}) QTest::keyClick(matrix, key);
  const document::SweepRun& second = outcome->sweep.at(2, 1);
  QVERIFY(Desktop::wait_for([&] { return desktop.state().parameters == second.parameters; }));
  desktop.wait_until_idle();
  QCOMPARE(desktop.state().step, second.steps);
}

void SweepStoryTest::what_the_runs_agree_on_shows_on_the_slices() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.begin(10.0);
  ui::SweepPanel& panel = *shown_panel(desktop);
  choose_counts(panel, 3, 3);
  run_all(desktop, panel);
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  QVERIFY(axial);
  const auto coloured = [&] {
    return count_of(*axial, [](const QColor& colour) {
      const auto [least, most] = std::minmax({colour.red(), colour.green(), colour.blue()});
      return most - least > 40;
    });
  };
  desktop.wait_until_idle();
  const int plain = coloured();
  QCheckBox* agreement = shown_check(panel, "Agreement on the slices");
  click(*agreement);
  QVERIFY(Desktop::wait_for([&] { return coloured() > plain + 1000; }));
  desktop.screenshot("sweep-4-agreement");
  QVERIFY(agreement->isChecked());
  click(*agreement);
  QVERIFY(Desktop::wait_for([&] { return coloured() < plain + 100; }));
}

void SweepStoryTest::what_the_runs_agree_on_shows_on_the_surface() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("bridge"));
  desktop.begin(6.0);
  ui::SweepPanel& panel = *shown_panel(desktop);
  choose_counts(panel, 3, 2);
  run_all(desktop, panel);
  click_run(panel, {2, 1});
  const std::int64_t steps = desktop.proxy().sweep().outcome()->sweep.at(2, 1).steps;
  QVERIFY(Desktop::wait_for([&] { return desktop.state().step == steps; }));
  desktop.wait_until_idle();
  auto* view = desktop.view<ui::VolumeViewWidget>();
  QVERIFY(view);
  // A plain surface is neither blue nor orange.
  const auto agreed = [&] {
    return count_of(*view, [](const QColor& colour) { return colour.blue() > colour.red() + 40; });
  };
  const auto apart = [&] {
    return count_of(*view, [](const QColor& colour) { return colour.red() > 3 * colour.blue() + 30; });
  };
  const int blue = agreed();
  const int orange = apart();
  QCheckBox* agreement = shown_check(panel, "Agreement on the surface");
  click(*agreement);
  QVERIFY(Desktop::wait_for([&] { return agreed() > blue + 500 && apart() > orange + 500; }));
  QVERIFY(agreement->isChecked());
  desktop.screenshot("sweep-7-agreement-on-the-surface");
  click(*agreement);
  QVERIFY(Desktop::wait_for([&] { return agreed() < blue + 100 && apart() < orange + 100; }));
}

void SweepStoryTest::a_sweep_is_given_up() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("tumour"));
  desktop.begin(9.0);
  ui::SweepPanel& panel = *shown_panel(desktop);
  choose_counts(panel, 8, 8);
  QTest::mouseClick(run_button(panel), Qt::LeftButton);
  QVERIFY(desktop.proxy().sweep().running());
  QVERIFY(Desktop::wait_for([&] { return run_button(panel)->text() == "Cancel"; }));
  desktop.screenshot_at_once("sweep-5-running");
  QTest::mouseClick(run_button(panel), Qt::LeftButton);
  QVERIFY(!desktop.proxy().sweep().running());  // at once, whatever the threads still do
  QCOMPARE(run_button(panel)->text(), QString("Run all"));
  QVERIFY(!desktop.proxy().sweep().outcome());
  QVERIFY(!panel.findChild<ui::SweepMatrix*>()->isVisible());

  // What cannot be run is said, and nothing runs.
  type(named<ui::NumberBox>(panel, "Across: last value"), "1.5");
  QTest::mouseClick(run_button(panel), Qt::LeftButton);
  QVERIFY(!desktop.proxy().sweep().running());
  bool said = false;
  for (const auto* label : panel.findChildren<QLabel*>())
    said = said || (label->isVisible() && label->text().contains("alpha must be between 0 and 1"));
  QVERIFY(said);
}

void SweepStoryTest::each_case_has_its_own_sweep() {
  Desktop desktop(story_executor(), {1366, 768});
  ui::CaseWindow* first = desktop.open_phantom("sphere");
  QVERIFY(first);
  desktop.begin(10.0);
  ui::SweepPanel& panel = *shown_panel(desktop);
  choose_counts(panel, 2, 2);
  run_all(desktop, panel);
  auto* matrix = panel.findChild<ui::SweepMatrix*>();
  QVERIFY(matrix->isVisible());
  QVERIFY(desktop.open_phantom("dumbbell"));
  desktop.window().panels().show("sweep");
  desktop.wait_until_idle();
  QVERIFY(!desktop.proxy().sweep().outcome());
  QVERIFY(!matrix->isVisible());
  desktop.press(Qt::Key_W, Qt::ControlModifier);
  QVERIFY(Desktop::wait_for([&] { return desktop.window().active_case() == first; }));
  QVERIFY(Desktop::wait_for([&] { return matrix->isVisible(); }));
}

void SweepStoryTest::an_arrangement_from_before_the_panel_still_opens() {
  Desktop desktop(solver::ExecutorKind::host, {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  ui::PanelDocks& panels = desktop.window().panels();
  auto* dock = desktop.window().findChild<QDockWidget*>("sweep");
  auto* statistics = desktop.window().findChild<QDockWidget*>("statistics");
  QVERIFY(dock && statistics);
  // Arrangements know panels by their names: none has this one's.
  dock->setObjectName("of-later-times");
  const QByteArray arrangement = panels.arrangement();
  dock->setObjectName("sweep");
  panels.restore(arrangement);
  desktop.wait_until_idle();
  for (const char* name : {"statistics", "sweep", "level-set"}) {
    panels.show(name);
    auto* shown = desktop.window().findChild<QDockWidget*>(name);
    QVERIFY2(Desktop::wait_for([&] { return shown->widget()->isVisible(); }), name);
    QVERIFY(!shown->isFloating());
    QCOMPARE(shown->width(), 320);
  }
  QVERIFY(desktop.window().tabifiedDockWidgets(statistics).contains(dock));
  desktop.screenshot("sweep-6-old-arrangement");
}

TIDEMARK_TEST(SweepStoryTest)

}  // namespace tidemark::test::sweep_story_test

#include "sweep_story_test.moc"
