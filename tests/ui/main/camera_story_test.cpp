// The 3D view comes to the surface by itself, and leaves the camera to whoever has taken it.
#include <QApplication>

#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"

namespace tidemark::test::camera_story_test {
namespace {

// Of what is not background in the picture of a 3D view.
struct Seen {
  double share = 0.0;    // of the picture's width or height, whichever it fills more
  bool touches = false;  // the picture's border
};

Seen seen_in(const ui::VolumeViewWidget& view) {
  const QImage& image = view.feed().shown().image;
  const QColor background = image.pixelColor(0, 0);
  QRect found;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      if (std::abs(image.pixelColor(x, y).red() - background.red()) > 30) found |= QRect(x, y, 1, 1);
    }
  }
  const double share = std::max(static_cast<double>(found.width()) / image.width(),
                                static_cast<double>(found.height()) / image.height());
  return {share, !found.isEmpty() && !image.rect().adjusted(1, 1, -1, -1).contains(found)};
}

}  // namespace

class CameraStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void the_camera_keeps_a_growing_surface_in_view();
  void a_camera_that_was_taken_stays();
  void reset_brings_the_surface_or_the_volume_into_view();

 private:
  static void play_to_the_end(Desktop& desktop);
};

void CameraStoryTest::play_to_the_end(Desktop& desktop) {
  desktop.press(Qt::Key_P);
  QVERIFY(Desktop::wait_for([&] { return desktop.state().converged; }, 120000));
  QTest::qWait(600);  // what glides comes to rest
  desktop.wait_until_idle();
}

void CameraStoryTest::the_camera_keeps_a_growing_surface_in_view() {
  Desktop desktop(story_executor(), {1280, 800});
  QVERIFY(desktop.open_phantom("tumour"));
  auto* view = desktop.view<ui::VolumeViewWidget>();
  QVERIFY(view);
  const renderer::Camera first = desktop.proxy().display().settings().camera;
  desktop.begin(9.0);
  desktop.screenshot("camera-1-begun");
  const renderer::Camera begun = desktop.proxy().display().settings().camera;
  QVERIFY(begun.zoom > first.zoom);
  QCOMPARE(begun.azimuth, first.azimuth);
  QCOMPARE(begun.elevation, first.elevation);
  QVERIFY(!seen_in(*view).touches);
  play_to_the_end(desktop);
  desktop.screenshot("camera-2-converged");
  const Seen at_end = seen_in(*view);
  qInfo("the surface takes %.2f of the picture", at_end.share);
  QVERIFY(!at_end.touches);
  QVERIFY2(at_end.share > 0.6, qPrintable(QString::number(at_end.share)));
}

void CameraStoryTest::a_camera_that_was_taken_stays() {
  Desktop desktop(story_executor(), {1280, 800});
  QVERIFY(desktop.open_phantom("tumour"));
  auto* view = desktop.view<ui::VolumeViewWidget>();
  QVERIFY(view);
  desktop.begin(9.0);
  const renderer::Camera begun = desktop.proxy().display().settings().camera;
  const QPoint middle = view->rect().center();
  const QPoint free(middle.x(), 60);  // of the large Play
  desktop.press(Qt::Key_W);
  Desktop::drag(static_cast<QWidget&>(*view), {free, free + QPoint(40, 10)});
  const renderer::Camera turned = desktop.proxy().display().settings().camera;
  QVERIFY(turned.azimuth != begun.azimuth);
  // At the same scale: a turn makes nothing larger or smaller.
  const Geometry& geometry = desktop.proxy().volume().geometry;
  const double aspect = static_cast<double>(view->width()) / view->height();
  QVERIFY(turned.zoom != begun.zoom);
  QVERIFY(std::abs(turned.half_height_mm(geometry, aspect) / begun.half_height_mm(geometry, aspect) - 1.0) <
          1e-9);
  // Nearer, so that the surface grows out of the picture.
  QWheelEvent wheel(middle, view->mapToGlobal(middle), {}, {0, 120 * 8}, Qt::NoButton, {}, Qt::NoScrollPhase,
                    false);
  QApplication::sendEvent(view, &wheel);
  const renderer::Camera taken = desktop.proxy().display().settings().camera;
  QVERIFY(taken.zoom > turned.zoom);
  play_to_the_end(desktop);
  QVERIFY(desktop.proxy().display().settings().camera == taken);
}

void CameraStoryTest::reset_brings_the_surface_or_the_volume_into_view() {
  Desktop desktop(story_executor(), {1280, 800});
  QVERIFY(desktop.open_phantom("tumour"));
  auto* view = desktop.view<ui::VolumeViewWidget>();
  QVERIFY(view);
  const QPoint middle = view->rect().center();
  const QPoint free(middle.x(), 60);  // of the hint
  desktop.press(Qt::Key_W);
  Desktop::drag(static_cast<QWidget&>(*view), {free, free + QPoint(90, 30)});
  Desktop::drag(static_cast<QWidget&>(*view), {free, free + QPoint(60, 50)}, Qt::MiddleButton);
  desktop.press(Qt::Key_R);
  const renderer::Camera of_volume = desktop.proxy().display().settings().camera;
  QCOMPARE(of_volume.zoom, 1.0);
  QVERIFY(!of_volume.focus_mm);
  desktop.begin(9.0);
  play_to_the_end(desktop);
  Desktop::drag(static_cast<QWidget&>(*view), {middle, middle + QPoint(90, 30)});
  Desktop::drag(static_cast<QWidget&>(*view), {middle, QPoint(middle.x(), 2 * middle.y() - 10)},
                Qt::MiddleButton);
  desktop.wait_until_idle();
  QVERIFY(seen_in(*view).touches);
  desktop.press(Qt::Key_R);
  desktop.wait_until_idle();
  desktop.screenshot("camera-3-reset");
  const Seen reset = seen_in(*view);
  qInfo("after R the surface takes %.2f of the picture", reset.share);
  QVERIFY(!reset.touches);
  QVERIFY2(reset.share > 0.6, qPrintable(QString::number(reset.share)));
  QCOMPARE(desktop.proxy().display().settings().camera.azimuth, of_volume.azimuth);
}

TIDEMARK_TEST(CameraStoryTest)

}  // namespace tidemark::test::camera_story_test

#include "camera_story_test.moc"
