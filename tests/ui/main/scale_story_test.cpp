// Screens of other scales: pictures have the screen's pixels, the mouse hits what is seen, texts fit.
#include <QApplication>
#include <QLabel>
#include <QMenuBar>
#include <QScreen>
#include <QSettings>
#include <QToolButton>
#include <glm/geometric.hpp>

#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "tests/ui/main/window_checks.h"

namespace tidemark::test::scale_story_test {

class ScaleStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void pictures_have_the_pixels_of_the_screen();
  void a_click_hits_what_is_seen();
  void texts_of_the_bars_fit();
  void panels_fit_into_their_column();
  void the_icon_of_a_case_is_whole();
  void the_window_opens_within_the_screen();
};

void ScaleStoryTest::pictures_have_the_pixels_of_the_screen() {
  const double scale = qEnvironmentVariable("QT_SCALE_FACTOR", "1").toDouble();
  Desktop desktop(story_executor(), {1000, 700});
  QCOMPARE(desktop.window().devicePixelRatioF(), scale);
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.begin(10.0);
  for (ui::PictureView* view : desktop.window().active_case()->views()) {
    const renderer::PictureSize size = view->physical_size();
    QCOMPARE(size.width, std::llround(view->width() * scale));
    QCOMPARE(size.height, std::llround(view->height() * scale));
    QVERIFY2(shows_a_picture(*view), qPrintable(view->title()));
    QCOMPARE(view->feed().shown().image.width(), static_cast<int>(size.width));
    QCOMPARE(view->feed().shown().image.height(), static_cast<int>(size.height));
    QCOMPARE(view->grab_picture().width(), static_cast<int>(size.width));
  }
  desktop.screenshot(QStringLiteral("scale-%1").arg(scale));
}

void ScaleStoryTest::a_click_hits_what_is_seen() {
  Desktop desktop(story_executor(), {1000, 700});
  QVERIFY(desktop.open_phantom("sphere"));
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  QVERIFY(axial);
  const Geometry& geometry = desktop.proxy().volume().geometry;
  const double voxel_mm = geometry.spacing_mm.x;
  const glm::dvec3 there = desktop.seed_mm() + glm::dvec3(9.0, -6.0, 0.0);
  desktop.proxy().display().change([](engine::DisplaySettings& s) { s.crosshair = false; });
  const double reach = std::max(axial->mm_per_pixel(), voxel_mm);
  desktop.press(Qt::Key_S);
  Desktop::drag(*axial, {there, there + glm::dvec3(3.0, 0.0, 0.0), there + glm::dvec3(8.0, 0.0, 0.0)});
  desktop.wait_until_idle();
  // The sphere is where the mouse was.
  QVERIFY(desktop.state().phi);
  const Mask inside = desktop.state().phi->mask();
  glm::dvec3 sum(0.0);
  std::int64_t count = 0;
  for (std::int64_t z = 0; z < geometry.size.z; ++z) {
    for (std::int64_t y = 0; y < geometry.size.y; ++y) {
      for (std::int64_t x = 0; x < geometry.size.x; ++x) {
        if (inside.voxels[static_cast<std::size_t>((z * geometry.size.y + y) * geometry.size.x + x)] == 0)
          continue;
        sum += geometry.to_patient({x, y, z});
        ++count;
      }
    }
  }
  QVERIFY(count > 0);
  const glm::dvec3 middle = sum / static_cast<double>(count);
  QVERIFY2(glm::distance(middle, there) < 1.5 * reach,
           qPrintable(QString::number(glm::distance(middle, there))));
  // And its outline is seen there: the middle of the yellow pixels of the picture.
  const QImage& image = axial->feed().shown().image;
  const double scale = axial->devicePixelRatioF();
  QPointF seen;
  int pixels = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const QColor colour = image.pixelColor(x, y);
      if (colour.red() < 200 || colour.green() < 160 || colour.blue() > 60) continue;
      seen += QPointF(x + 0.5, y + 0.5) / scale;
      ++pixels;
    }
  }
  QVERIFY(pixels > 20);
  const QPointF away = seen / pixels - axial->position_of(there);
  QVERIFY2(std::hypot(away.x(), away.y()) * axial->mm_per_pixel() < 1.5 * reach,
           qPrintable(QString("%1 %2").arg(away.x()).arg(away.y())));
}

void ScaleStoryTest::texts_of_the_bars_fit() {
  Desktop desktop(story_executor(), {1250, 820});
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.begin(10.0);
  desktop.window().active_case()->set_layout(ui::ViewLayout::two_two);
  desktop.wait_until_idle();
  QCOMPARE(cut_bars(desktop.window()).join("; "), QString());
}

void ScaleStoryTest::panels_fit_into_their_column() {
  Desktop desktop(solver::ExecutorKind::host, {1100, 760});
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.begin(10.0);
  QCOMPARE(panels_too_wide(desktop, QString::number(desktop.window().devicePixelRatioF())).join("; "),
           QString());
}

void ScaleStoryTest::the_icon_of_a_case_is_whole() {
  Desktop desktop(solver::ExecutorKind::host, {1000, 700});
  QVERIFY(desktop.open_phantom("sphere"));
  QMenuBar* bar = desktop.window().menuBar();
  const QWidget* label = bar->cornerWidget(Qt::TopLeftCorner);
  QVERIFY(label && label->isVisible());
  // Qt gives it more room than there is before the first menu.
  const QRect place = label->geometry() & QRect(0, 0, 24, bar->height());
  const QImage image = bar->grab(place).toImage().convertToFormat(QImage::Format_RGB32);
  QRect drawn;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      if (image.pixelColor(x, y) != desktop.window().palette().color(QPalette::Window))
        drawn |= QRect(x, y, 1, 1);
    }
  }
  const double scale = desktop.window().devicePixelRatioF();
  // What is clipped on dense screens is its lower part; the first menu's text may begin within the place.
  QVERIFY2(std::abs(drawn.height() - 16 * scale) <= 2 * scale,
           qPrintable(QString("%1 x %2").arg(drawn.width()).arg(drawn.height())));
}

// A laptop's screen at 200 %: nobody has chosen a size yet.
void ScaleStoryTest::the_window_opens_within_the_screen() {
  const TemporaryFolder settings;
  QSettings::setPath(QSettings::IniFormat, QSettings::UserScope,
                     QString::fromStdString(settings.path().string()));
  engine::Engine engine;
  ui::MainWindow window(engine);
  window.show();
  QVERIFY(QTest::qWaitForWindowExposed(&window));
  const QSize room = window.screen()->availableSize();
  const QSize needed = window.frameGeometry().size();
  QVERIFY2(needed.width() <= room.width() && needed.height() <= room.height(),
           qPrintable(QStringLiteral("%1 x %2").arg(needed.width()).arg(needed.height())));
}

TIDEMARK_TEST(ScaleStoryTest)

}  // namespace tidemark::test::scale_story_test

#include "scale_story_test.moc"
