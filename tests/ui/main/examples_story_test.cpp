// Strokes of examples, walls and anchors, painted by mouse and keys.
#include <QAbstractButton>
#include <QComboBox>
#include <QLabel>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "solver/speed/speed_registry.h"
#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "ui/main/panel_docks.h"
#include "ui/panels/example_controls.h"
#include "ui/panels/wall_controls.h"

namespace tidemark::test {

class ExamplesStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void strokes_are_painted_shown_and_undone();
  void strokes_go_into_the_case_under_the_mouse();
  void walls_and_anchors_are_painted_and_cleared();
  void what_was_erased_does_not_grow_back();

 private:
  static const document::Drive& drive(Desktop& desktop) { return desktop.proxy().drive(); }
  static std::size_t inside(Desktop& desktop) {
    return drive(desktop).strokes ? drive(desktop).strokes->inside.size() : 0;
  }
  static std::size_t outside(Desktop& desktop) {
    return drive(desktop).strokes ? drive(desktop).strokes->outside.size() : 0;
  }
  static bool is_driven_by(Desktop& desktop, const char* function) {
    const auto& terms = drive(desktop).setting.terms;
    return terms.size() == 1 && terms.front().function == function;
  }
  // Pixels of the overlay in which one colour leads, by so much.
  static int orange_pixels(const ui::PictureView& view);
  template <class Widget>
  static Widget* seen(QWidget& in, const QString& text);
};

int ExamplesStoryTest::orange_pixels(const ui::PictureView& view) {
  const QImage picture = const_cast<ui::PictureView&>(view).grab_picture();
  int count = 0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const QColor colour = picture.pixelColor(x, y);
      count += colour.red() > colour.blue() + 60 && colour.red() > colour.green() + 20 ? 1 : 0;
    }
  }
  return count;
}

template <class Widget>
Widget* ExamplesStoryTest::seen(QWidget& in, const QString& text) {
  for (Widget* widget : in.findChildren<Widget*>()) {
    if (widget->isVisible() && (widget->text() == text || widget->accessibleName() == text)) return widget;
  }
  return nullptr;
}

void ExamplesStoryTest::strokes_are_painted_shown_and_undone() {
  Desktop desktop(story_executor(), {1382, 858});
  QVERIFY(desktop.open_phantom("sphere"));
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  QVERIFY(axial);
  const glm::dvec3 middle = desktop.proxy().display().settings().cursor_mm;
  const char* const with_examples = solver::speed_kind("examples") ? "examples" : "tent";
  const int orange_before = orange_pixels(*axial);
  desktop.press(Qt::Key_M);
  QVERIFY(desktop.proxy().display().settings().tool == engine::Tool::examples);

  Desktop::drag(*axial, {middle, middle + glm::dvec3(6.0, 0.0, 0.0)});
  desktop.wait_until_idle();
  const std::size_t first = inside(desktop);
  QVERIFY(first > 30 && outside(desktop) == 0);
  // In one slice, that of the view.
  const Geometry& geometry = desktop.proxy().volume().geometry;
  const std::int64_t slice = std::llround(geometry.to_voxel(middle).z);
  for (const std::int64_t offset : drive(desktop).strokes->inside)
    QCOMPARE(offset / (geometry.size.x * geometry.size.y), slice);
  QVERIFY(is_driven_by(desktop, "tent"));  // one kind alone teaches nothing
  QVERIFY(orange_pixels(*axial) > orange_before + 100);

  // Until the button is released all views show what will be.
  Desktop::mouse(*axial, QEvent::MouseButtonPress, middle + glm::dvec3(0.0, 8.0, 0.0));
  QVERIFY(desktop.proxy().display().drawn_marks());
  QCOMPARE(inside(desktop), first);
  Desktop::mouse(*axial, QEvent::MouseMove, middle + glm::dvec3(6.0, 8.0, 0.0));
  const std::size_t drawn = desktop.proxy().display().drawn_marks()->strokes->inside.size();
  QVERIFY(drawn > first);
  Desktop::mouse(*axial, QEvent::MouseButtonRelease, middle + glm::dvec3(6.0, 8.0, 0.0));
  desktop.wait_until_idle();
  QVERIFY(!desktop.proxy().display().drawn_marks());
  QCOMPARE(inside(desktop), drawn);

  // With the first stroke outside the surface is driven by examples.
  Desktop::drag(*axial, {middle + glm::dvec3(-25.0, -25.0, 0.0), middle + glm::dvec3(-15.0, -25.0, 0.0)},
                Qt::RightButton);
  desktop.wait_until_idle();
  QVERIFY(outside(desktop) > 30);
  QVERIFY(is_driven_by(desktop, with_examples));
  const std::size_t second = outside(desktop);

  // Ctrl takes away, where it goes over.
  Desktop::drag(*axial, {middle + glm::dvec3(0.0, 8.0, 0.0), middle + glm::dvec3(6.0, 8.0, 0.0)},
                Qt::LeftButton, Qt::ControlModifier);
  desktop.wait_until_idle();
  QCOMPARE(inside(desktop), first);
  QCOMPARE(outside(desktop), second);

  // One stroke is one entry of the history.
  desktop.press(Qt::Key_Z, Qt::ControlModifier);
  desktop.wait_until_idle();
  QCOMPARE(inside(desktop), drawn);
  desktop.press(Qt::Key_Z, Qt::ControlModifier);
  desktop.wait_until_idle();
  QCOMPARE(outside(desktop), std::size_t{0});
  QVERIFY(is_driven_by(desktop, "tent"));
  desktop.press(Qt::Key_Z, Qt::ControlModifier);
  desktop.press(Qt::Key_Z, Qt::ControlModifier);
  desktop.wait_until_idle();
  QVERIFY(!drive(desktop).strokes);
  QCOMPARE(orange_pixels(*axial), orange_before);
  for (int redo = 0; redo < 3; ++redo) desktop.press(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  desktop.wait_until_idle();
  QCOMPARE(outside(desktop), second);
  QVERIFY(is_driven_by(desktop, with_examples));

  // The panel clears all of it, and says what is missing then.
  desktop.window().panels().show("level-set");
  desktop.wait_until_idle();
  auto* panel = desktop.window().findChild<ui::ExampleControls*>();
  QVERIFY(panel && panel->isVisible());
  auto* clear = seen<QAbstractButton>(*panel, "Clear strokes");
  QVERIFY(clear && clear->isEnabled());
  QTest::mouseClick(clear, Qt::LeftButton);
  desktop.wait_until_idle();
  QVERIFY(!drive(desktop).strokes);
  QVERIFY(is_driven_by(desktop, "tent"));
  QVERIFY(seen<QLabel>(*panel, "Paint inside with the left button, outside with the right one."));
}

void ExamplesStoryTest::strokes_go_into_the_case_under_the_mouse() {
  Desktop desktop(story_executor(), {1200, 760});
  ui::CaseWindow* one = desktop.open_phantom("sphere");
  ui::CaseWindow* two = desktop.open_phantom("tumour");
  desktop.window().actions().tile->trigger();
  desktop.wait_until_idle();
  desktop.press(Qt::Key_M);  // the second is active
  for (ui::CaseWindow* under : {one, two}) {
    ui::CaseWindow* other = under == one ? two : one;
    const auto before = other->proxy().drive().strokes;
    auto* slice = qobject_cast<ui::SliceViewWidget*>(under->views().first());
    QVERIFY(slice && slice->isVisible());
    const glm::dvec3 middle = under->proxy().display().settings().cursor_mm;
    Desktop::drag(*slice, {middle, middle + glm::dvec3(5.0, 0.0, 0.0)});
    desktop.wait_until_idle();
    QVERIFY(under->proxy().drive().strokes);
    QCOMPARE(other->proxy().drive().strokes, before);
  }
}

void ExamplesStoryTest::walls_and_anchors_are_painted_and_cleared() {
  Desktop desktop(story_executor(), {1382, 858});
  QVERIFY(desktop.open_phantom("sphere"));
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  const glm::dvec3 middle = desktop.proxy().display().settings().cursor_mm;
  const auto count = [&](solver::Constraint what) {
    const auto& constraints = drive(desktop).constraints;
    return constraints ? constraints->count(what) : 0;
  };
  desktop.press(Qt::Key_K);
  Desktop::drag(*axial, {middle + glm::dvec3(12.0, -8.0, 0.0), middle + glm::dvec3(12.0, 8.0, 0.0)});
  Desktop::drag(*axial, {middle, middle}, Qt::LeftButton, Qt::ShiftModifier);
  desktop.wait_until_idle();
  QVERIFY(count(solver::Constraint::wall) > 50);
  QVERIFY(count(solver::Constraint::anchor) > 20);
  desktop.window().panels().show("paint");
  desktop.wait_until_idle();
  desktop.screenshot("walls");
  Desktop::drag(*axial, {middle, middle}, Qt::RightButton);
  desktop.wait_until_idle();
  QCOMPARE(count(solver::Constraint::anchor), 0);
  auto* panel = desktop.window().findChild<ui::WallControls*>();
  QVERIFY(panel && panel->isVisible());
  auto* clear = seen<QAbstractButton>(*panel, "Clear walls and anchors");
  QVERIFY(clear);
  QTest::mouseClick(clear, Qt::LeftButton);
  desktop.wait_until_idle();
  QVERIFY(!drive(desktop).constraints);
  desktop.press(Qt::Key_Z, Qt::ControlModifier);
  desktop.wait_until_idle();
  QVERIFY(count(solver::Constraint::wall) > 50);
}

void ExamplesStoryTest::what_was_erased_does_not_grow_back() {
  Desktop desktop(story_executor(), {1382, 858});
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.begin(10.0);
  desktop.press(Qt::Key_P);
  QVERIFY(Desktop::wait_for([&] { return desktop.state().step > 0 && !desktop.state().playing; }, 60000));
  desktop.wait_until_idle();
  const glm::dvec3 at = desktop.seed_mm();
  const auto encloses = [&] {
    return desktop.state().phi->at(Index3(glm::round(desktop.proxy().volume().geometry.to_voxel(at)))) > 0.0F;
  };
  QVERIFY(encloses());
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  const auto erase_and_play = [&] {
    desktop.press(Qt::Key_E);
    Desktop::drag(*axial, {at, at});
    desktop.wait_until_idle();
    QVERIFY(!encloses());
    const std::int64_t before = desktop.state().step;
    desktop.press(Qt::Key_P);
    QVERIFY(
        Desktop::wait_for([&] { return desktop.state().step > before && !desktop.state().playing; }, 60000));
    desktop.wait_until_idle();
  };
  erase_and_play();
  QVERIFY(encloses());  // it has grown back

  desktop.window().panels().show("paint");
  desktop.wait_until_idle();
  auto* panel = desktop.window().findChild<ui::WallControls*>();
  auto* check = seen<QAbstractButton>(*panel, "Erasing leaves a wall");
  QVERIFY(check);
  QTest::mouseClick(check, Qt::LeftButton, {}, {8, check->height() / 2});
  erase_and_play();
  QVERIFY(!encloses());
  // The stroke and its wall are one entry.
  desktop.press(Qt::Key_Z, Qt::ControlModifier);  // the run
  desktop.press(Qt::Key_Z, Qt::ControlModifier);
  desktop.wait_until_idle();
  QVERIFY(!drive(desktop).constraints);
  QVERIFY(encloses());
}

}  // namespace tidemark::test

TIDEMARK_TEST(tidemark::test::ExamplesStoryTest)
#include "examples_story_test.moc"
