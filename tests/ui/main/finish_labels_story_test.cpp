// Labels are finished by tools: chosen, looked at in slices, applied and undone, by mouse and keys.
#include <QAbstractButton>
#include <QComboBox>
#include <QLabel>
#include <QMenu>
#include <QTableView>

#include "engine/label_finisher.h"
#include "imaging/regions/margin.h"
#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "ui/main/panel_docks.h"
#include "ui/panels/labels_panel.h"
#include "ui/widgets/number_box.h"

namespace tidemark::test::finish_labels_story_test {

class FinishLabelsStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void a_label_grows_is_smoothed_and_split();
  void a_tool_works_on_the_case_that_is_seen();
  void the_brush_paints_the_chosen_label_and_no_other();
  void an_outline_takes_what_it_goes_around();
  void a_polygon_is_drawn_by_clicks();
  void a_label_is_chosen_where_it_is_seen();

 private:
  static void click(Desktop& desktop, QWidget& in, const QString& text) {
    auto* button = seen<QAbstractButton>(in, text);
    QVERIFY2(button->isEnabled(), qPrintable(text));
    QTest::mouseClick(button, Qt::LeftButton, {}, {8, button->height() / 2});
    desktop.wait_until_idle();
  }
  static ui::LabelsPanel* shown_panel(Desktop& desktop) {
    desktop.window().panels().show("labels");
    desktop.wait_until_idle();
    auto* panel = desktop.window().findChild<ui::LabelsPanel*>();
    if (!panel || !panel->isVisible()) qFatal("there is no panel");
    return panel;
  }
  // By keys, until it is the current one.
  static void choose(QWidget& in, const QString& combo, const QString& entry) {
    auto* choice = seen<QComboBox>(in, combo);
    choice->setFocus();
    QTest::keyClick(choice, Qt::Key_Home);
    for (int i = 0; i < choice->count() && choice->currentText() != entry; ++i)
      QTest::keyClick(choice, Qt::Key_Down);
    QCOMPARE(choice->currentText(), entry);
  }
  static void wait_for_preview(Desktop& desktop, ui::LabelsPanel& panel) {
    QVERIFY(Desktop::wait_for([&] { return seen<QAbstractButton>(panel, "Apply to labels")->isEnabled(); }));
    QVERIFY(desktop.proxy().label_finisher().is_current());
    desktop.wait_until_idle();
  }
  static void type_amount(QWidget& panel, const QString& text) {
    auto* box = seen<ui::NumberBox>(panel, "Amount");
    QTest::mouseClick(box, Qt::LeftButton);
    box->selectAll();
    QTest::keyClicks(box, text);
    QTest::keyClick(box, Qt::Key_Tab);
  }
  static Region region(Desktop& desktop, std::uint8_t label) {
    const auto& voxels = desktop.state().label_voxels;
    return voxels ? Region(*voxels, label, desktop.proxy().volume().geometry.size) : Region();
  }
  static void make_label(Desktop& desktop, ui::LabelsPanel& panel) {
    desktop.begin(8.0);
    click(desktop, panel, "Accept surface into label");
    QCOMPARE(desktop.state().labels.size(), std::size_t{1});
  }
};

void FinishLabelsStoryTest::a_label_grows_is_smoothed_and_split() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  ui::LabelsPanel& panel = *shown_panel(desktop);
  make_label(desktop, panel);
  const Geometry& grid = desktop.proxy().volume().geometry;
  const Region before = region(desktop, 1);
  const QImage without = desktop.view<ui::SliceViewWidget>("Axial")->grab_picture();

  choose(panel, "Tool", "Grow");
  type_amount(panel, "4,5");  // either separator is understood
  wait_for_preview(desktop, panel);
  desktop.screenshot("finish-0-grow");
  // Slices show it, and nothing is changed yet.
  QVERIFY(region(desktop, 1) == before);
  QVERIFY(difference(desktop.view<ui::SliceViewWidget>("Axial")->grab_picture(), without) > 0.0005);
  const Region wanted = imaging::grown(before, grid, 4.5).value();
  QVERIFY(desktop.proxy().label_finisher().preview()->regions.front().region == wanted);
  click(desktop, panel, "Apply to labels");
  QVERIFY(region(desktop, 1) == wanted);
  QVERIFY(!desktop.proxy().label_finisher().preview());
  QCOMPARE(desktop.state().undo_text, QString("finishing of Label 1"));
  desktop.screenshot("finish-1-grown");

  choose(panel, "Tool", "Split at the clip plane");
  wait_for_preview(desktop, panel);
  desktop.screenshot("finish-2-split");
  click(desktop, panel, "Apply to labels");
  QCOMPARE(desktop.state().labels.size(), std::size_t{2});
  QVERIFY(tidemark::united(region(desktop, 1), region(desktop, 2)) == wanted);
  desktop.press(Qt::Key_Z, Qt::ControlModifier);
  desktop.wait_until_idle();
  desktop.press(Qt::Key_Z, Qt::ControlModifier);
  desktop.wait_until_idle();
  QVERIFY(region(desktop, 1) == before);
  QCOMPARE(desktop.state().labels.size(), std::size_t{1});

  // What cannot be done is said, and nothing is applied.
  choose(panel, "Tool", "Fill between slices");
  QVERIFY(Desktop::wait_for([&] {
    for (QLabel* label : panel.findChildren<QLabel*>()) {
      if (label->isVisible() && label->text().contains("no empty slice")) return true;
    }
    return false;
  }));
  QVERIFY(!seen<QAbstractButton>(panel, "Apply to labels")->isEnabled());
  desktop.screenshot("finish-3-refused");
}

void FinishLabelsStoryTest::a_tool_works_on_the_case_that_is_seen() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  ui::LabelsPanel& panel = *shown_panel(desktop);
  make_label(desktop, panel);
  auto* first = desktop.window().active_case();
  choose(panel, "Tool", "Shrink");
  wait_for_preview(desktop, panel);
  // Another case: the tool is put away, and the first case's preview with it.
  QVERIFY(desktop.open_phantom("dumbbell"));
  desktop.wait_until_idle();
  QCOMPARE(seen<QComboBox>(panel, "Tool")->currentText(), QString("None"));
  QVERIFY(!first->proxy().label_finisher().preview());
  QVERIFY(!desktop.proxy().label_finisher().preview());
}

void FinishLabelsStoryTest::the_brush_paints_the_chosen_label_and_no_other() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  const glm::dvec3 seed = desktop.seed_mm();
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  // By its key, without the panel: the first stroke makes a label, the next one goes on with it.
  desktop.press(Qt::Key_Q);
  QCOMPARE(desktop.proxy().display().settings().tool, engine::Tool::label);
  QVERIFY(desktop.menu_entry("Tools", "Label brush")->isChecked());
  desktop.drag(*axial, {seed, seed + glm::dvec3(10.0, 0.0, 0.0)});
  desktop.wait_until_idle();
  QCOMPARE(desktop.state().labels.size(), std::size_t{1});
  const Region first = region(desktop, 1);
  const double radius = desktop.proxy().display().settings().brush_mm;
  const VoxelRange box = first.bounds();
  QVERIFY(static_cast<double>(box.high.x - box.low.x) > 9.0 + 2.0 * radius);  // of 1 mm
  QVERIFY(static_cast<double>(first.count()) > 10.0 * radius);
  QCOMPARE(first.bounds().high.z - first.bounds().low.z, std::int64_t{1});  // one slice
  desktop.drag(*axial, {seed + glm::dvec3(0.0, 14.0, 0.0)}, Qt::LeftButton, Qt::ShiftModifier);
  desktop.wait_until_idle();
  QCOMPARE(desktop.state().labels.size(), std::size_t{1});
  const Region with_ball = region(desktop, 1);
  QVERIFY(static_cast<double>(with_ball.bounds().high.z - with_ball.bounds().low.z) > 2.0 * radius - 1.0);
  QVERIFY(difference(first, with_ball).empty());
  QCOMPARE(desktop.state().undo_text, QString("brush on Label 1"));
  desktop.screenshot("brush-0-label");

  // Another label leaves its voxels alone, and takes away from itself only.
  ui::LabelsPanel& panel = *shown_panel(desktop);
  click(desktop, panel, "Add");
  click(desktop, panel, "Brush");
  desktop.drag(*axial, {seed, seed + glm::dvec3(0.0, 10.0, 0.0)});
  desktop.wait_until_idle();
  const Region second = region(desktop, 2);
  QVERIFY(second.count() > 0);
  QVERIFY(region(desktop, 1) == with_ball);
  desktop.drag(*axial, {seed - glm::dvec3(8.0, 0.0, 0.0), seed + glm::dvec3(8.0, 10.0, 0.0)},
               Qt::RightButton);
  desktop.wait_until_idle();
  QVERIFY(region(desktop, 1) == with_ball);
  QVERIFY(region(desktop, 2).count() < second.count());
  desktop.screenshot("brush-1-second");

  // With Ctrl only what is as bright as the first voxel: the ball's own voxels, and none of the background.
  const Volume& volume = desktop.proxy().volume();
  click(desktop, panel, "Add");
  desktop.drag(*axial, {seed - glm::dvec3(16.0, 0.0, 0.0), seed - glm::dvec3(26.0, 0.0, 0.0)}, Qt::LeftButton,
               Qt::ControlModifier);
  desktop.wait_until_idle();
  const Region like = region(desktop, 3);
  QVERIFY(like.count() > 0);
  const float inside = volume.value(Index3(glm::round(volume.geometry.to_voxel(seed))));
  const auto tolerance = static_cast<float>(desktop.state().parameters.range);
  like.for_each_run([&](Index3 voxel, std::int64_t length) {
    for (std::int64_t i = 0; i < length; ++i)
      QVERIFY(std::abs(volume.value(voxel + Index3(i, 0, 0)) - inside) <= tolerance);
  });
  for (int stroke = 0; stroke < 3; ++stroke) {
    desktop.press(Qt::Key_Z, Qt::ControlModifier);
    desktop.wait_until_idle();
  }
  QVERIFY(region(desktop, 2) == second);
}

void FinishLabelsStoryTest::an_outline_takes_what_it_goes_around() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  ui::LabelsPanel& panel = *shown_panel(desktop);
  const glm::dvec3 seed = desktop.seed_mm();
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  click(desktop, panel, "Outline");
  QVERIFY(!seen<QAbstractButton>(panel, "Brush")->isChecked());
  // Around a square of 20 mm, whose last side closes it by itself.
  const auto corner = [&](double x, double y) { return seed + glm::dvec3(x, y, 0.0); };
  desktop.drag(*axial, {corner(-10.2, -10.2), corner(10.2, -10.2), corner(10.2, 10.2), corner(-10.2, 10.2)});
  desktop.wait_until_idle();
  QCOMPARE(desktop.state().labels.size(), std::size_t{1});
  const Region square = region(desktop, 1);
  QCOMPARE(square.bounds().high.z - square.bounds().low.z, std::int64_t{1});
  QVERIFY2(std::abs(static_cast<double>(square.count()) - 20.4 * 20.4) < 45.0,
           qPrintable(QString::number(square.count())));
  desktop.screenshot("outline-0-square");
  // A part of it goes again.
  desktop.drag(*axial, {corner(0.0, -14.0), corner(14.0, -14.0), corner(14.0, 14.0), corner(0.0, 14.0)},
               Qt::RightButton);
  desktop.wait_until_idle();
  const Region half = region(desktop, 1);
  QVERIFY(difference(half, square).empty());
  QVERIFY(std::abs(static_cast<double>(half.count()) - 0.5 * static_cast<double>(square.count())) < 30.0);
  desktop.press(Qt::Key_Z, Qt::ControlModifier);
  desktop.wait_until_idle();
  QVERIFY(region(desktop, 1) == square);
  // The brush is itself again.
  click(desktop, panel, "Brush");
  QVERIFY(!seen<QAbstractButton>(panel, "Outline")->isChecked());
  desktop.drag(*axial, {corner(-25.0, 0.0), corner(-15.0, 0.0)});
  desktop.wait_until_idle();
  QVERIFY(region(desktop, 1).count() > square.count());
}

void FinishLabelsStoryTest::a_polygon_is_drawn_by_clicks() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  ui::LabelsPanel& panel = *shown_panel(desktop);
  const glm::dvec3 seed = desktop.seed_mm();
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  QVERIFY(axial);
  click(desktop, panel, "Outline");
  const auto place = [&](double x, double y) {
    return axial->position_of(seed + glm::dvec3(x, y, 0.0)).toPoint();
  };
  const auto click_at = [&](QPoint at) {
    QTest::mouseMove(axial, at);
    QTest::mouseClick(axial, Qt::LeftButton, {}, at);
  };
  const QList<QPoint> corners{place(-10.2, -10.2), place(10.2, -10.2), place(10.2, 10.2), place(-10.2, 10.2)};
  for (const QPoint corner : corners) click_at(corner);
  QTest::mouseMove(axial, place(-16.0, 0.0));
  desktop.screenshot("outline-1-polygon");
  QVERIFY(desktop.state().labels.empty());  // until it is closed
  // Another tool, Escape and the wheel end nothing by accident: the polygon goes, and nothing is painted.
  QTest::keyClick(axial, Qt::Key_Escape);
  desktop.wait_until_idle();
  QVERIFY(desktop.state().labels.empty());

  for (const QPoint corner : corners) click_at(corner);
  QTest::mouseDClick(axial, Qt::LeftButton, {}, corners.back());  // which ends with the second press
  QTest::mouseRelease(axial, Qt::LeftButton, {}, corners.back());
  desktop.wait_until_idle();
  QCOMPARE(desktop.state().labels.size(), std::size_t{1});
  const Region square = region(desktop, 1);
  QVERIFY2(std::abs(static_cast<double>(square.count()) - 20.4 * 20.4) < 45.0,
           qPrintable(QString::number(square.count())));
  // The first corner closes it as well, and so does Return.
  const auto undo = [&] {
    desktop.press(Qt::Key_Z, Qt::ControlModifier);
    desktop.wait_until_idle();
  };
  undo();
  for (const QPoint corner : corners) click_at(corner);
  click_at(corners.front());
  desktop.wait_until_idle();
  QVERIFY(region(desktop, 1) == square);
  undo();
  for (const QPoint corner : corners) click_at(corner);
  QTest::keyClick(axial, Qt::Key_Return);
  desktop.wait_until_idle();
  QVERIFY(region(desktop, 1) == square);
}

void FinishLabelsStoryTest::a_label_is_chosen_where_it_is_seen() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  ui::LabelsPanel& panel = *shown_panel(desktop);
  const glm::dvec3 left = desktop.seed_mm() - glm::dvec3(12.0, 0.0, 0.0);
  const glm::dvec3 right = desktop.seed_mm() + glm::dvec3(12.0, 0.0, 0.0);
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  desktop.press(Qt::Key_Q);
  desktop.drag(*axial, {left});
  desktop.wait_until_idle();
  click(desktop, panel, "Add");
  desktop.drag(*axial, {right});
  desktop.wait_until_idle();
  QCOMPARE(desktop.state().labels.size(), std::size_t{2});
  // The menu of the place has its label. A brush has the right button for itself: the Menu key asks.
  const auto entry_at = [&](glm::dvec3 place_mm) -> QAction* {
    desktop.proxy().display().change(
        [&](engine::DisplaySettings& settings) { settings.cursor_mm = place_mm; });
    axial->setFocus();
    QTest::keyClick(axial, Qt::Key_Menu);
    if (!Desktop::wait_for([] { return QApplication::activePopupWidget() != nullptr; })) return nullptr;
    for (QAction* action : QApplication::activePopupWidget()->actions()) {
      if (action->text().contains("&label")) return action;
    }
    return nullptr;
  };
  QAction* entry = entry_at(left);
  QVERIFY(entry && entry->isEnabled());
  QVERIFY2(entry->text().contains("Label 1"), qPrintable(entry->text()));
  desktop.screenshot_at_once("label-menu");
  auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
  QTest::mouseClick(menu, Qt::LeftButton, {}, menu->actionGeometry(entry).center());
  desktop.wait_until_idle();
  const std::int64_t second = region(desktop, 2).count();
  desktop.drag(*axial, {left + glm::dvec3(0.0, 12.0, 0.0)});
  desktop.wait_until_idle();
  QCOMPARE(region(desktop, 2).count(), second);  // the stroke went into the first
  entry = entry_at(desktop.seed_mm() + glm::dvec3(0.0, -25.0, 0.0));
  QVERIFY(entry && !entry->isEnabled());
  QApplication::activePopupWidget()->close();
}

TIDEMARK_TEST(FinishLabelsStoryTest)

}  // namespace tidemark::test::finish_labels_story_test

#include "finish_labels_story_test.moc"
