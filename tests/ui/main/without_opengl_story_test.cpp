// A machine without OpenGL: the processor draws, and nothing else is different. Driven by clicks that the
// window hands on to whatever lies there.
#include <QAbstractButton>
#include <QLabel>

#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "ui/views/next_step.h"
#include "ui/views/picture_surface.h"

namespace tidemark::test::without_opengl_story_test {
namespace {

void click(QWidget& widget, QPoint at) {
  QWidget& window = *widget.window();
  QTest::mouseClick(window.windowHandle(), Qt::LeftButton, {}, widget.mapTo(&window, at));
}
void click(QWidget& widget) {
  click(widget, widget.rect().center());
}

// By its name or text.
template <class Widget>
Widget* seen(Desktop& desktop, const QString& name) {
  for (Widget* widget : desktop.window().findChildren<Widget*>()) {
    const bool named = widget->objectName() == name || widget->text() == name;
    if (named && widget->isVisible()) return widget;
  }
  return nullptr;
}

// Pixels in the colour of the surface, which is redder than anything else in 3D.
int pixels_of_the_surface(const QImage& picture) {
  int count = 0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const QColor colour = picture.pixelColor(x, y);
      count += colour.red() > colour.blue() + 30 ? 1 : 0;
    }
  }
  return count;
}

}  // namespace

class WithoutOpenglStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void a_phantom_is_opened_placed_played_and_turned();
  void the_status_bar_says_who_draws();
};

void WithoutOpenglStoryTest::a_phantom_is_opened_placed_played_and_turned() {
  Desktop desktop(solver::ExecutorKind::automatic, {1382, 858}, false);
  auto* card = seen<QAbstractButton>(desktop, "phantom_tumour");
  QVERIFY(card);
  click(*card);
  QVERIFY(Desktop::wait_for([&] { return desktop.window().active_case() != nullptr; }, 60000));
  desktop.wait_until_idle();
  for (const ui::PictureView* view : desktop.window().active_case()->views()) {
    if (!view->isVisible()) continue;
    QCOMPARE(view->surface(), nullptr);
    QVERIFY2(view->feed().shown().finished, qPrintable(view->title()));
  }
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  auto* volume = desktop.view<ui::VolumeViewWidget>();
  QVERIFY(axial && volume);
  QVERIFY(shows_a_picture(*axial));
  const int before = pixels_of_the_surface(volume->feed().shown().image);

  click(*axial, axial->position_of(desktop.seed_mm()).toPoint());
  QVERIFY(Desktop::wait_for([&] { return desktop.state().begun; }));
  desktop.wait_until_idle();
  const int placed = pixels_of_the_surface(volume->feed().shown().image);
  QVERIFY2(placed > before + 100, qPrintable(QString("%1, then %2").arg(before).arg(placed)));
  desktop.screenshot("without-opengl-1-placed");

  auto* play = seen<ui::PlayButton>(desktop, "Play");
  QVERIFY(play);
  const std::uint64_t pictures = volume->feed().shown().number;
  click(*play);
  QVERIFY(Desktop::wait_for([&] { return desktop.state().playing && desktop.state().step > 20; }));
  desktop.screenshot_at_once("without-opengl-2-playing");
  QVERIFY(Desktop::wait_for([&] { return !desktop.state().playing; }, 240000));
  desktop.wait_until_idle();
  QVERIFY(desktop.state().converged);
  QCOMPARE(desktop.state().executor, QString("host"));
  QVERIFY(volume->feed().shown().number > pictures + 5);
  QCOMPARE(volume->feed().shown().step, desktop.state().step);
  QVERIFY(desktop.state().dice && *desktop.state().dice > 0.97);
  desktop.screenshot("without-opengl-3-converged");
  // Drawn where the executor has it.
  const PhiTraffic traffic = desktop.phi_traffic(desktop.proxy());
  QCOMPARE(traffic.copies, 0);
  QCOMPARE(traffic.pages_uploaded, 0);

  // Turned by the mouse.
  const QImage from_here = volume->feed().shown().image.copy();
  const glm::dvec3 middle = renderer::middle_of(desktop.proxy().volume().geometry);
  const QPoint centre = volume->position_of(middle).toPoint();
  const std::uint64_t still = volume->feed().shown().number;
  Desktop::drag(static_cast<QWidget&>(*volume),
                {centre, centre + QPoint(20, 0), centre + QPoint(60, 10), centre + QPoint(120, 20)});
  QVERIFY(Desktop::wait_for([&] { return volume->feed().shown().number > still; }));
  desktop.wait_until_idle();
  QVERIFY(difference(volume->feed().shown().image, from_here) > 0.01);
  QVERIFY(volume->feed().shown().finished);
  desktop.screenshot("without-opengl-4-turned");
}

void WithoutOpenglStoryTest::the_status_bar_says_who_draws() {
  Desktop desktop(solver::ExecutorKind::host, {900, 640}, false);
  const auto* note = desktop.window().findChild<QLabel*>("renderer note");
  QVERIFY(note && note->isVisible());
  QCOMPARE(note->text(), QString("Drawn by the processor"));
  QVERIFY2(note->toolTip().contains("there is no OpenGL"), qPrintable(note->toolTip()));
  QVERIFY2(note->toolTip().contains("OpenGL was not wanted"), qPrintable(note->toolTip()));
}

TIDEMARK_TEST(WithoutOpenglStoryTest)

}  // namespace tidemark::test::without_opengl_story_test

#include "without_opengl_story_test.moc"
