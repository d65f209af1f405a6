// Labels painted by hand, by mouse and keys: with the brush, around, along edges, and on some values alone.
#include <QAbstractButton>
#include <QComboBox>
#include <QMenu>
#include <QMouseEvent>
#include <QTableView>
#include <QWheelEvent>
#include <cmath>
#include <future>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/case_runner.h"
#include "imaging/files/volume_file.h"
#include "tests/support/grid.h"
#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "tests/ui/main/labels_desktop.h"
#include "ui/panels/label_tool_controls.h"
#include "ui/panels/labels_model.h"
#include "ui/views/next_step.h"
#include "ui/widgets/number_box.h"

namespace tidemark::test::paint_labels_story_test {

class PaintLabelsStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void the_brush_paints_the_chosen_label_and_no_other();
  void the_brush_paints_a_ball_on_the_clip_plane();
  void an_outline_takes_what_it_goes_around();
  void a_polygon_is_drawn_by_clicks();
  void a_livewire_follows_the_edge_between_clicks();
  void only_voxels_with_certain_values_are_painted();
  void a_label_is_chosen_where_it_is_seen();
  void a_stroke_lies_in_the_slice_that_is_seen();
  void escape_gives_a_stroke_up();
  void a_stroke_ends_once_its_button_is_no_longer_held();
  void a_stroke_keeps_to_its_slice();
  void strokes_that_wait_for_the_engine_paint_one_label();
  void the_place_under_a_resting_mouse_follows_the_slice();
  void space_ticks_a_cell_of_the_table_and_keeps_the_tool();

 private:
  static void undo(Desktop& desktop) {
    desktop.press(Qt::Key_Z, Qt::ControlModifier);
    desktop.wait_until_idle();
  }
  static void click_at(QWidget& view, QPoint at) {
    QTest::mouseMove(&view, at);
    QTest::mouseClick(&view, Qt::LeftButton, {}, at);
  }
};

void PaintLabelsStoryTest::the_brush_paints_the_chosen_label_and_no_other() {
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

void PaintLabelsStoryTest::an_outline_takes_what_it_goes_around() {
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

void PaintLabelsStoryTest::a_polygon_is_drawn_by_clicks() {
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
  const QList<QPoint> corners{place(-10.2, -10.2), place(10.2, -10.2), place(10.2, 10.2), place(-10.2, 10.2)};
  for (const QPoint corner : corners) click_at(*axial, corner);
  QTest::mouseMove(axial, place(-16.0, 0.0));
  desktop.screenshot("outline-1-polygon");
  QVERIFY(desktop.state().labels.empty());  // until it is closed
  // Another tool, Escape and the wheel end nothing by accident: the polygon goes, and nothing is painted.
  QTest::keyClick(axial, Qt::Key_Escape);
  desktop.wait_until_idle();
  QVERIFY(desktop.state().labels.empty());

  for (const QPoint corner : corners) click_at(*axial, corner);
  QTest::mouseDClick(axial, Qt::LeftButton, {}, corners.back());  // which ends with the second press
  QTest::mouseRelease(axial, Qt::LeftButton, {}, corners.back());
  desktop.wait_until_idle();
  QCOMPARE(desktop.state().labels.size(), std::size_t{1});
  const Region square = region(desktop, 1);
  QVERIFY2(std::abs(static_cast<double>(square.count()) - 20.4 * 20.4) < 45.0,
           qPrintable(QString::number(square.count())));
  // The first corner closes it as well, and so does Return.
  undo(desktop);
  for (const QPoint corner : corners) click_at(*axial, corner);
  click_at(*axial, corners.front());
  desktop.wait_until_idle();
  QVERIFY(region(desktop, 1) == square);
  undo(desktop);
  for (const QPoint corner : corners) click_at(*axial, corner);
  QTest::keyClick(axial, Qt::Key_Return);
  desktop.wait_until_idle();
  QVERIFY(region(desktop, 1) == square);
}

void PaintLabelsStoryTest::a_label_is_chosen_where_it_is_seen() {
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

// Six clicks near the edge of a ball give its outline, of which a polygon of them would miss a sixth.
void PaintLabelsStoryTest::a_livewire_follows_the_edge_between_clicks() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  ui::LabelsPanel& panel = *shown_panel(desktop);
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  click(desktop, panel, "Livewire");
  QVERIFY(seen<QAbstractButton>(panel, "Livewire")->isChecked());
  QVERIFY(!seen<QAbstractButton>(panel, "Outline")->isChecked());
  const auto& truth = desktop.proxy().study().truth;
  QVERIFY(truth);
  const Geometry& grid = desktop.proxy().volume().geometry;
  const auto slice = std::llround(grid.to_voxel(desktop.proxy().display().settings().cursor_mm).z);
  const Region disc =
      intersection(Region(*truth), whole({{0, 0, slice}, {grid.size.x, grid.size.y, slice + 1}}));
  const VoxelRange bounds = disc.bounds();
  const glm::dvec3 middle =
      0.5 * (grid.to_patient(glm::dvec3(bounds.low)) + grid.to_patient(glm::dvec3(bounds.high - Index3(1))));
  const double radius_mm = 0.5 * grid.spacing_mm.x * static_cast<double>(bounds.high.x - bounds.low.x);
  QList<QPoint> corners;
  for (int n = 0; n < 6; ++n) {
    const double angle = std::numbers::pi * n / 3.0;
    const double radius = radius_mm + (n % 2 == 0 ? 1.0 : -1.0);
    corners
        << axial->position_of(middle + radius * glm::dvec3(std::cos(angle), std::sin(angle), 0.0)).toPoint();
  }
  for (const QPoint corner : corners) click_at(*axial, corner);
  QTest::mouseMove(axial, (corners.back() + corners.front()) / 2);
  desktop.screenshot("livewire-0-drawing");
  QVERIFY(desktop.state().labels.empty());  // until it is closed
  click_at(*axial, corners.front());
  desktop.wait_until_idle();
  desktop.screenshot("livewire-1-label");
  QCOMPARE(desktop.state().labels.size(), std::size_t{1});
  const Region painted = region(desktop, 1);
  const double dice = 2.0 * static_cast<double>(tidemark::intersection(painted, disc).count()) /
                      static_cast<double>(painted.count() + disc.count());
  QVERIFY2(dice > 0.96, qPrintable(QString::number(dice)));
  // Straight lines between the same clicks.
  undo(desktop);
  click(desktop, panel, "Outline");
  for (const QPoint corner : corners) click_at(*axial, corner);
  click_at(*axial, corners.front());
  desktop.wait_until_idle();
  QVERIFY(static_cast<double>(region(desktop, 1).count()) < 0.9 * static_cast<double>(disc.count()));
}

void PaintLabelsStoryTest::only_voxels_with_certain_values_are_painted() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  ui::LabelsPanel& panel = *shown_panel(desktop);
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  const glm::dvec3 seed = desktop.seed_mm();
  const auto square = [&] {
    const auto corner = [&](double x, double y) { return seed + glm::dvec3(x, y, 0.0); };
    desktop.drag(*axial,
                 {corner(-50.0, -50.0), corner(50.0, -50.0), corner(50.0, 50.0), corner(-50.0, 50.0)});
    desktop.wait_until_idle();
  };
  const auto values_are_within = [&](double low, double high) {
    const Volume& source = *desktop.proxy().source();
    bool within = true;
    region(desktop, 1).for_each_run([&](Index3 voxel, std::int64_t length) {
      for (std::int64_t i = 0; i < length; ++i) {
        const double value = source.value(voxel + Index3(i, 0, 0));
        within = within && value >= low && value <= high;
      }
    });
    return within;
  };
  click(desktop, panel, "Outline");
  QVERIFY(!find_seen<ui::NumberBox>(panel, "From"));
  click(desktop, panel, "Only values");
  const solver::Parameters& parameters = desktop.proxy().parameters();
  const double low = parameters.target - parameters.range;
  const double high = parameters.target + parameters.range;
  QCOMPARE(seen<ui::NumberBox>(panel, "From")->value(), low);
  QCOMPARE(seen<ui::NumberBox>(panel, "Up to")->value(), high);
  square();
  // The card that says how to begin a surface leaves the labels in 3D to be seen.
  const auto* solid = desktop.view<ui::VolumeViewWidget>();
  const auto* card = desktop.window().findChild<ui::NextStep*>();
  QVERIFY(card->isVisible() && !card->geometry().contains(solid->rect().center()));
  desktop.screenshot("values-0-within");
  const std::int64_t most = region(desktop, 1).count();
  QVERIFY(most > 500);
  QVERIFY(values_are_within(low, high));
  // A narrower range, typed; the other end gives way to one beyond it.
  undo(desktop);
  const auto type = [&](const QString& box, double value) {
    auto* number = seen<ui::NumberBox>(panel, box);
    QTest::mouseClick(number, Qt::LeftButton);
    number->selectAll();
    QTest::keyClicks(number, QString::number(value));
    QTest::keyClick(number, Qt::Key_Tab);
    desktop.wait_until_idle();
  };
  type("From", parameters.target);
  square();
  QVERIFY(region(desktop, 1).count() < most);
  QVERIFY(values_are_within(parameters.target, high));
  type("Up to", low);
  QCOMPARE(seen<ui::NumberBox>(panel, "From")->value(), low);
  // All values again.
  undo(desktop);
  click(desktop, panel, "Only values");
  QVERIFY(!find_seen<ui::NumberBox>(panel, "From"));
  square();
  QVERIFY(region(desktop, 1).count() > most);
}

// Of an even number of slices none lies in the middle.
void PaintLabelsStoryTest::a_stroke_lies_in_the_slice_that_is_seen() {
  const TemporaryFolder folder;
  const auto file = folder / "even.nii.gz";
  Volume volume;
  volume.geometry = grid_of({40, 48, 30}, {1.0, 1.5, 3.0});
  std::vector<std::int16_t> values(static_cast<std::size_t>(volume.geometry.voxel_count()));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<std::int16_t>(i % 97);
  volume.voxels = std::move(values);
  QCOMPARE(failure(imaging::write_volume_file(volume, file)), QString());
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open(QString::fromStdString(file.string())));
  desktop.wait_until_idle();
  ui::LabelsPanel& panel = *shown_panel(desktop);
  desktop.press(Qt::Key_2, Qt::ControlModifier);  // one large, three small
  desktop.wait_until_idle();
  std::uint8_t label = 0;
  for (const auto& [name, axis] :
       {std::pair("Axial", 2), std::pair("Coronal", 1), std::pair("Sagittal", 0)}) {
    auto* view = desktop.view<ui::SliceViewWidget>(name);
    QVERIFY2(view && view->isVisible(), name);
    for (const int clicks : {0, 1, -3}) {
      view->setFocus();
      for (int i = 0; i < std::abs(clicks); ++i)
        QTest::keyClick(view, clicks > 0 ? Qt::Key_Up : Qt::Key_Down);
      const glm::dvec3 cursor = desktop.proxy().display().settings().cursor_mm;
      const Index3 seen(glm::round(desktop.proxy().volume().geometry.to_voxel(cursor)));
      click(desktop, panel, "Add");
      click(desktop, panel, "Brush");
      Desktop::drag(*view, {cursor, cursor});
      desktop.wait_until_idle();
      const VoxelRange box = region(desktop, ++label).bounds();
      QVERIFY2(
          box.low[axis] == seen[axis] && box.high[axis] == seen[axis] + 1,
          qPrintable(
              QString("%1 %2: %3 to %4").arg(name).arg(seen[axis]).arg(box.low[axis]).arg(box.high[axis])));
      // All labels are measured with the state that shows them.
      std::int64_t voxels = 0;
      for (const auto& one : desktop.state().label_statistics) voxels += one.voxels;
      std::int64_t painted = 0;
      for (std::uint8_t id = 1; id <= label; ++id) painted += region(desktop, id).count();
      QCOMPARE(voxels, painted);
      if (label == 1) desktop.screenshot("brush-even");
      undo(desktop);  // there is room for the next one
    }
  }
}

void PaintLabelsStoryTest::escape_gives_a_stroke_up() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  const glm::dvec3 seed = desktop.seed_mm();
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  desktop.press(Qt::Key_Q);
  for (const bool given_up : {true, false}) {
    Desktop::mouse(*axial, QEvent::MouseButtonPress, seed);
    Desktop::mouse(*axial, QEvent::MouseMove, seed + glm::dvec3(8.0, 0.0, 0.0));
    QVERIFY(desktop.proxy().display().drawn_label());
    if (given_up) QTest::keyClick(axial, Qt::Key_Escape);
    QCOMPARE(desktop.proxy().display().drawn_label() == nullptr, given_up);
    Desktop::mouse(*axial, QEvent::MouseMove, seed + glm::dvec3(9.0, 0.0, 0.0));
    Desktop::mouse(*axial, QEvent::MouseButtonRelease, seed + glm::dvec3(9.0, 0.0, 0.0));
    desktop.wait_until_idle();
    QCOMPARE(desktop.state().labels.empty(), given_up);
  }
}

// As after a dialog that has opened under it.
void PaintLabelsStoryTest::a_stroke_ends_once_its_button_is_no_longer_held() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  const glm::dvec3 seed = desktop.seed_mm();
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  desktop.press(Qt::Key_Q);
  Desktop::mouse(*axial, QEvent::MouseButtonPress, seed);
  Desktop::mouse(*axial, QEvent::MouseMove, seed + glm::dvec3(4.0, 0.0, 0.0));
  QVERIFY(desktop.proxy().display().drawn_label());
  for (const double beside_mm : {20.0, 24.0}) {
    const QPointF there = axial->position_of(seed + glm::dvec3(beside_mm, 0.0, 0.0));
    QMouseEvent move(QEvent::MouseMove, there, axial->mapToGlobal(there), Qt::NoButton, Qt::NoButton, {});
    QApplication::sendEvent(axial, &move);
    QVERIFY(!desktop.proxy().display().drawn_label());
  }
  desktop.wait_until_idle();
  QCOMPARE(desktop.state().labels.size(), std::size_t{1});
  const Geometry& grid = desktop.proxy().volume().geometry;
  const Region painted = region(desktop, 1);
  QVERIFY(painted.contains(Index3(glm::round(grid.to_voxel(seed)))));
  const double end_mm = 6.0 + desktop.proxy().display().settings().brush_mm;
  QVERIFY(static_cast<double>(painted.bounds().high.x) <
          grid.to_voxel(seed + glm::dvec3(end_mm, 0.0, 0.0)).x);
}

void PaintLabelsStoryTest::a_stroke_keeps_to_its_slice() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  const glm::dvec3 seed = desktop.seed_mm();
  const Geometry& grid = desktop.proxy().volume().geometry;
  engine::Display& display = desktop.proxy().display();
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  desktop.press(Qt::Key_Q);
  const glm::dvec3 cursor = display.settings().cursor_mm;
  const auto slice = std::llround(grid.to_voxel(cursor).z);
  const auto beside = [&](double x, double y) { return seed + glm::dvec3(x, y, 0.0); };
  const auto is_in_slice = [&](const Region& painted) {
    return painted.bounds().low.z == slice && painted.bounds().high.z == slice + 1;
  };
  // The wheel waits for the button.
  const auto turn_wheel = [&] {
    const QPointF there = axial->position_of(seed);
    QWheelEvent wheel(there, axial->mapToGlobal(there), {}, {0, 120}, Qt::LeftButton, {}, Qt::NoScrollPhase,
                      false);
    QApplication::sendEvent(axial, &wheel);
  };
  Desktop::mouse(*axial, QEvent::MouseButtonPress, beside(0.0, 0.0));
  turn_wheel();
  QVERIFY(display.settings().cursor_mm == cursor);
  Desktop::mouse(*axial, QEvent::MouseMove, beside(8.0, 0.0));
  Desktop::mouse(*axial, QEvent::MouseButtonRelease, beside(8.0, 0.0));
  desktop.wait_until_idle();
  QCOMPARE(desktop.state().labels.size(), std::size_t{1});
  const Region first = region(desktop, 1);
  QVERIFY(is_in_slice(first));
  // Where a leak, or a linked case, shows another slice, the stroke has ended.
  Desktop::mouse(*axial, QEvent::MouseButtonPress, beside(0.0, 20.0));
  display.change([&](engine::DisplaySettings& settings) { settings.cursor_mm.z += grid.spacing_mm.z; });
  QVERIFY(!display.drawn_label());
  Desktop::mouse(*axial, QEvent::MouseMove, beside(20.0, 20.0));
  Desktop::mouse(*axial, QEvent::MouseButtonRelease, beside(20.0, 20.0));
  desktop.wait_until_idle();
  const Region both = region(desktop, 1);
  QVERIFY(is_in_slice(both));
  QVERIFY(both.count() > first.count());
  QVERIFY(both.bounds().high.x == first.bounds().high.x);
  turn_wheel();
  QVERIFY(display.settings().cursor_mm.z != cursor.z + grid.spacing_mm.z);
}

void PaintLabelsStoryTest::strokes_that_wait_for_the_engine_paint_one_label() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  const glm::dvec3 seed = desktop.seed_mm();
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  desktop.press(Qt::Key_Q);
  std::promise<void> go_on;
  desktop.proxy().runner()->post(
      [goes_on = go_on.get_future().share()](engine::CaseRunner&, const Progress&) -> Status {
        goes_on.wait();
        return {};
      });
  const auto beside = [&](double x) { return seed + glm::dvec3(x, 0.0, 0.0); };
  Desktop::drag(*axial, {beside(-20.0), beside(-14.0)});
  Desktop::drag(*axial, {beside(14.0), beside(20.0)});
  Desktop::drag(*axial, {beside(-20.0), beside(-14.0)}, Qt::RightButton);
  QVERIFY(desktop.state().labels.empty());
  go_on.set_value();
  desktop.wait_until_idle();
  QCOMPARE(desktop.state().labels.size(), std::size_t{1});
  const Geometry& grid = desktop.proxy().volume().geometry;
  const auto voxel_at = [&](glm::dvec3 place) { return Index3(glm::round(grid.to_voxel(place))); };
  QVERIFY(region(desktop, 1).contains(voxel_at(beside(17.0))));
  QVERIFY(!region(desktop, 1).contains(voxel_at(beside(-17.0))));
}

void PaintLabelsStoryTest::the_place_under_a_resting_mouse_follows_the_slice() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  Desktop::hover(*axial, axial->rect().center() + QPoint(20, 10));
  const auto& place = desktop.proxy().display().pointer_mm();
  QVERIFY(Desktop::wait_for([&] { return place.has_value(); }));
  const glm::dvec3 before = *place;
  axial->setFocus();
  QTest::keyClick(axial, Qt::Key_Up);
  QVERIFY(place.has_value());
  QCOMPARE(std::abs(place->z - before.z), desktop.proxy().volume().geometry.spacing_mm.z);
  QCOMPARE(place->x, before.x);
}

void PaintLabelsStoryTest::the_brush_paints_a_ball_on_the_clip_plane() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.begin(4.0);
  auto* view = desktop.view<ui::VolumeViewWidget>();
  const glm::dvec3 centre = desktop.seed_mm();
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, 1.0, 0.2));
  const glm::dvec3 place = centre + 12.0 * glm::normalize(glm::cross(normal, {0.3, 0.1, 1.0}));
  desktop.proxy().display().change([&](engine::DisplaySettings& s) {
    s.camera.zoom = 3.0;
    s.camera.focus_mm = centre;
    s.clip.normal = normal;
    s.clip.offset_mm = glm::dot(normal, centre);
  });
  desktop.press(Qt::Key_X);
  desktop.press(Qt::Key_Q);
  desktop.wait_until_idle();
  Desktop::drag(*view, {place});
  desktop.wait_until_idle();
  QCOMPARE(desktop.state().labels.size(), std::size_t{1});
  // On both sides of the plane, around the place.
  const double radius = desktop.proxy().display().settings().brush_mm;
  const Geometry& grid = desktop.proxy().volume().geometry;
  const Region painted = region(desktop, 1);
  const auto reach = static_cast<std::int64_t>(std::ceil(radius)) + 3;
  const Index3 middle(glm::round(grid.to_voxel(place)));
  std::int64_t near = 0;
  for (std::int64_t k = -reach; k <= reach; ++k) {
    for (std::int64_t j = -reach; j <= reach; ++j) {
      for (std::int64_t i = -reach; i <= reach; ++i) {
        const Index3 voxel = middle + Index3(i, j, k);
        const double away = glm::distance(grid.to_patient(glm::dvec3(voxel)), place);
        if (away < radius - 1.5) QVERIFY(painted.contains(voxel));
        if (away < radius + 1.5) near += painted.contains(voxel) ? 1 : 0;
      }
    }
  }
  QVERIFY(near > 20);
  QCOMPARE(painted.count(), near);  // and nowhere else
  desktop.screenshot("brush-3-clip-plane");
  Desktop::drag(*view, {place}, Qt::RightButton);
  desktop.wait_until_idle();
  QVERIFY(region(desktop, 1).empty());
}

void PaintLabelsStoryTest::space_ticks_a_cell_of_the_table_and_keeps_the_tool() {
  Desktop desktop(solver::ExecutorKind::host, {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  for (const Qt::Key tool : {Qt::Key_C, Qt::Key_W}) desktop.press(tool);
  ui::LabelsPanel& panel = *shown_panel(desktop);
  click(desktop, panel, "Add");
  auto* table = panel.findChild<QTableView*>();
  QVERIFY(table && table->isVisible());
  const auto ticks = [&](int column) {
    const document::Label& label = desktop.state().labels.front();
    return column == ui::LabelsModel::visible ? label.visible : label.locked;
  };
  const auto press_space = [&] {
    QTest::keyClick(desktop.window().windowHandle(), Qt::Key_Space);
    desktop.wait_until_idle();
  };
  for (const int column : {ui::LabelsModel::visible, ui::LabelsModel::locked}) {
    const QRect cell = table->visualRect(table->model()->index(0, column));
    QTest::mouseClick(table->viewport(), Qt::LeftButton, {}, cell.topLeft() + QPoint(2, 2));
    desktop.wait_until_idle();
    QVERIFY(table->hasFocus());
    for (int press = 0; press < 2; ++press) {
      const bool before = ticks(column);
      press_space();
      QCOMPARE(ticks(column), !before);
      QCOMPARE(desktop.proxy().display().settings().tool, engine::Tool::window);
    }
  }
  // A cell without a tick has no use for it.
  table->setCurrentIndex(table->model()->index(0, ui::LabelsModel::name));
  press_space();
  QCOMPARE(desktop.proxy().display().settings().tool, engine::Tool::crosshair);
  // It opens a list of choices.
  auto* choice = panel.findChild<ui::LabelToolControls*>()->findChild<QComboBox*>();
  QVERIFY(choice && choice->isVisible());
  choice->setFocus();
  press_space();
  QVERIFY(choice->view()->isVisible());
  QTest::keyClick(choice->view(), Qt::Key_Escape);
  QVERIFY(Desktop::wait_for([&] { return !choice->view()->isVisible(); }));
  QCOMPARE(desktop.proxy().display().settings().tool, engine::Tool::crosshair);
}

TIDEMARK_TEST(PaintLabelsStoryTest)

}  // namespace tidemark::test::paint_labels_story_test

#include "paint_labels_story_test.moc"
