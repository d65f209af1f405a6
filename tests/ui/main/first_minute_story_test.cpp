// Card, place, play: the first minute with nothing but what the desktop itself offers, by clicks that the
// window hands on to whatever lies there.
#include <QAbstractButton>
#include <QCheckBox>
#include <QPushButton>
#include <glm/geometric.hpp>

#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "ui/main/panel_docks.h"
#include "ui/views/next_step.h"

namespace tidemark::test::first_minute_story_test {

class FirstMinuteStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void a_card_a_click_and_play_lead_to_the_tumour();
  void keys_lead_there_too();
  void the_hint_brings_tool_and_panel();

 private:
  // Where a user would: the window finds out what is there.
  static void click(QWidget& widget, QPoint at);
  static void click(QWidget& widget) { click(widget, widget.rect().center()); }
  // To what has the keyboard.
  static void press(Desktop& desktop, Qt::Key key);
  template <class Widget>
  static Widget* seen(Desktop& desktop, const QString& name);
};

void FirstMinuteStoryTest::click(QWidget& widget, QPoint at) {
  QWidget& window = *widget.window();
  QTest::mouseClick(window.windowHandle(), Qt::LeftButton, {}, widget.mapTo(&window, at));
}

void FirstMinuteStoryTest::press(Desktop& desktop, Qt::Key key) {
  QTest::keyClick(desktop.window().windowHandle(), key);
}

// A button by its name or text.
template <class Widget>
Widget* FirstMinuteStoryTest::seen(Desktop& desktop, const QString& name) {
  for (Widget* widget : desktop.window().template findChildren<Widget*>()) {
    const bool named = widget->objectName() == name || widget->text() == name;
    if (named && widget->isVisible()) return widget;
  }
  return nullptr;
}

void FirstMinuteStoryTest::a_card_a_click_and_play_lead_to_the_tumour() {
  Desktop desktop(story_executor(), {1382, 858});
  auto* card = seen<QAbstractButton>(desktop, "phantom_tumour");
  QVERIFY(card);
  click(*card);
  QVERIFY(Desktop::wait_for([&] { return desktop.window().active_case() != nullptr; }, 60000));
  desktop.wait_until_idle();
  auto* next = desktop.window().findChild<ui::NextStep*>();
  QVERIFY(next && next->isVisible());
  QVERIFY(!seen<ui::PlayButton>(desktop, "Play"));
  desktop.screenshot("first-1-opened");

  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  QVERIFY(axial);
  click(*axial, axial->position_of(desktop.seed_mm()).toPoint());
  QVERIFY(Desktop::wait_for([&] { return desktop.state().begun; }));
  desktop.wait_until_idle();
  auto* play = seen<ui::PlayButton>(desktop, "Play");
  QVERIFY(play);
  QVERIFY(play->width() >= 80 && play->height() >= 80);
  auto* volume = desktop.view<ui::VolumeViewWidget>();
  QVERIFY(volume);
  const QRect place(play->mapTo(volume, QPoint()), play->size());
  QVERIFY(std::abs(place.center().x() - volume->rect().center().x()) <= 4);
  QVERIFY(volume->rect().contains(place));
  QVERIFY(!place.contains(volume->rect().center()));  // where the surface is
  const double placed_ml = desktop.state().surface.volume_ml;
  desktop.screenshot("first-2-placed");

  click(*play);
  QVERIFY(Desktop::wait_for([&] { return desktop.state().playing && desktop.state().step > 5; }));
  QVERIFY(!play->isVisible());
  const double early = desktop.state().dice.value_or(0.0);
  QVERIFY(Desktop::wait_for([&] { return desktop.state().playing && *desktop.state().dice > early + 0.05; }));
  desktop.screenshot_at_once("first-3-playing");
  QVERIFY(Desktop::wait_for([&] { return !desktop.state().playing; }, 240000));
  desktop.wait_until_idle();
  desktop.screenshot("first-4-converged");
  QVERIFY(desktop.state().converged);
  QVERIFY(desktop.state().surface.volume_ml > 2.0 * placed_ml);
  QVERIFY2(std::abs(desktop.state().surface.volume_ml / 117.6 - 1.0) < 0.04,
           qPrintable(QString::number(desktop.state().surface.volume_ml)));
  QVERIFY(!play->isVisible());

  // As the card promises: compared with the truth, whose outline can be seen.
  QVERIFY(desktop.state().dice && *desktop.state().dice > 0.97);
  const auto violet_pixels = [&] {
    const QImage picture = axial->grab_picture();
    int count = 0;
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) {
        const QColor colour = picture.pixelColor(x, y);
        const bool is_violet = colour.blue() > colour.green() + 60 && colour.red() > colour.green() + 30;
        count += is_violet ? 1 : 0;
      }
    }
    return count;
  };
  QCOMPARE(violet_pixels(), 0);
  auto* truth = seen<QCheckBox>(desktop, "Show the truth");
  QVERIFY(truth);
  click(*truth, {8, truth->height() / 2});
  desktop.wait_until_idle();
  QVERIFY2(violet_pixels() > 100, qPrintable(QString::number(violet_pixels())));
  desktop.screenshot("first-5-truth");
  click(*truth, {8, truth->height() / 2});

  // From the start once more.
  desktop.press(Qt::Key_Home);
  QVERIFY(Desktop::wait_for([&] { return play->isVisible(); }));
}

void FirstMinuteStoryTest::keys_lead_there_too() {
  Desktop desktop(story_executor(), {1100, 700});
  QVERIFY(desktop.open_phantom("sphere"));
  QVERIFY(desktop.proxy().display().settings().tool == engine::Tool::seed);
  desktop.begin(10.0);
  auto* play = seen<ui::PlayButton>(desktop, "Play");
  QVERIFY(play && play->accessibleName() == "Play");
  desktop.view<ui::SliceViewWidget>("Axial")->setFocus();
  for (int tab = 0; tab < 60 && !play->hasFocus(); ++tab) press(desktop, Qt::Key_Tab);
  QVERIFY(play->hasFocus());
  press(desktop, Qt::Key_Space);  // not the key of the tool before
  QVERIFY(Desktop::wait_for([&] { return desktop.state().step > 0; }));
  QVERIFY(desktop.proxy().display().settings().tool == engine::Tool::window);  // a drag turns the view
  QVERIFY(!play->isVisible());
  QVERIFY(desktop.view<ui::VolumeViewWidget>()->hasFocus());
  QVERIFY(Desktop::wait_for([&] { return !desktop.state().playing; }, 60000));

  desktop.press(Qt::Key_Home);
  QVERIFY(Desktop::wait_for([&] { return play->isVisible(); }));
  play->setFocus();
  press(desktop, Qt::Key_Return);
  QVERIFY(Desktop::wait_for([&] { return desktop.state().step > 0; }));

  auto* pause = seen<QCheckBox>(desktop, "Pause at convergence");
  QVERIFY(pause && pause->isChecked());
  pause->setFocus();
  press(desktop, Qt::Key_Space);
  QVERIFY(!pause->isChecked());
}

void FirstMinuteStoryTest::the_hint_brings_tool_and_panel() {
  Desktop desktop(solver::ExecutorKind::host, {1100, 700});
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.press(Qt::Key_W);
  desktop.window().panels().show("labels");
  desktop.wait_until_idle();
  auto* next = desktop.window().findChild<ui::NextStep*>();
  QVERIFY(next && next->isVisible());
  auto* place = next->findChild<QPushButton*>();
  QVERIFY(place && place->text() == "Sphere tool");
  // With another tool a click places nothing, and the hint does not say so.
  auto* how = next->findChild<QLabel*>();
  QVERIFY(how && how->text().startsWith("Place a surface: take the sphere tool."));
  click(*place);
  desktop.wait_until_idle();
  QVERIFY(how->text().startsWith("Place a surface: click in the tissue"));
  QVERIFY(desktop.proxy().display().settings().tool == engine::Tool::seed);
  QVERIFY(seen<QAbstractButton>(desktop, "Draw in a view"));
  // What is looked at is not covered.
  desktop.press(Qt::Key_X);
  QVERIFY(!next->isVisible());
  desktop.press(Qt::Key_X);
  QVERIFY(next->isVisible());
}

TIDEMARK_TEST(FirstMinuteStoryTest)

}  // namespace tidemark::test::first_minute_story_test

#include "first_minute_story_test.moc"
