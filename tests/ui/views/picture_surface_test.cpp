// Pictures that reach the views as textures, beside those that are read back.
#include "ui/views/picture_surface.h"

#include <QApplication>
#include <QDockWidget>
#include <QObject>
#include <QScreen>
#include <set>

#include "engine/case_runner.h"
#include "engine/view_textures.h"
#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"

namespace tidemark::test::picture_surface_test {
namespace {

// Engine::pictures() is chosen when the engine is made.
class DesktopWith : public Desktop {
 public:
  explicit DesktopWith(const char* pictures, QSize size = {800, 600}) : Desktop(ask_for(pictures), size) {}
  ~DesktopWith() {
    // This thread puts the textures together, which is work of the processor where OpenGL is.
    WatchedApplication::instance().forget_held();
    qunsetenv("TIDEMARK_PICTURES");
    qunsetenv("TIDEMARK_RENDERER");
  }

  std::vector<ui::PictureView*> views() {
    std::vector<ui::PictureView*> views;
    for (ui::PictureView* view : window().active_case()->views()) {
      if (view->isVisible()) views.push_back(view);
    }
    return views;
  }
  std::int64_t pictures_read_back() {
    wait_until_idle();
    return proxy().runner()->painter().pictures_read_back();
  }

 private:
  static solver::ExecutorKind ask_for(const char* pictures) {
    qputenv("TIDEMARK_PICTURES", pictures);
    qputenv("TIDEMARK_RENDERER", "gl");
    return solver::ExecutorKind::automatic;
  }
};

// With a level set inside.
void open_sphere(Desktop& desktop) {
  QVERIFY(desktop.open_phantom("sphere"));
  const Geometry& geometry = desktop.proxy().volume().geometry;
  document::Start start;
  start.seeds.push_back({geometry.to_patient(0.5 * glm::dvec3(geometry.size - Index3(1))), 12.0});
  desktop.proxy().begin(start);
  desktop.proxy().step();  // the large Play leaves the view
  desktop.wait_until_idle();
}

// The screen, after Qt has put all widgets together.
QImage on_screen(ui::PictureView& view) {
  const QWidget& window = *view.window();
  QTest::qWait(50);
  QImage all = window.screen()->grabWindow(window.winId()).toImage();
  all.setDevicePixelRatio(1.0);
  const double ratio = view.devicePixelRatioF();
  return all.copy(QRect(view.mapTo(&window, QPoint(0, 0)) * ratio, view.size() * ratio))
      .convertToFormat(QImage::Format_RGB32);
}

}  // namespace

class PictureSurfaceTest : public QObject {
  Q_OBJECT

 private slots:
  void textures_show_what_images_show_and_nothing_is_read_back();
  void views_survive_being_undocked_docked_and_put_into_tabs();
  void the_mouse_and_the_keyboard_reach_the_view();
  void a_texture_that_somebody_holds_is_not_drawn_into();
  void a_lost_context_of_the_engine_costs_one_picture();
  void a_case_is_closed_while_its_pictures_are_drawn();
};

void PictureSurfaceTest::textures_show_what_images_show_and_nothing_is_read_back() {
  std::vector<QImage> images;
  std::vector<QImage> screens;
  for (const char* way : {"images", "textures"}) {
    const bool textures = way == std::string_view("textures");
    DesktopWith desktop(way, {1280, 800});
    const WId window = desktop.window().winId();
    open_sphere(desktop);
    QCOMPARE(desktop.window().winId(), window);  // one that is made anew flickers
    QCOMPARE(desktop.engine().pictures() == engine::Engine::Pictures::textures, textures);
    const auto views = desktop.views();
    QVERIFY(views.size() >= 3);
    for (std::size_t i = 0; i < views.size(); ++i) {
      QCOMPARE(views[i]->surface() != nullptr, textures);
      QVERIFY(views[i]->feed().shown().finished);
      if (!textures) {
        images.push_back(views[i]->grab_picture());
        screens.push_back(on_screen(*views[i]));
        continue;
      }
      QVERIFY(views[i]->feed().shown().image.isNull());
      const double differ = difference(views[i]->grab_picture(), images[i]);
      const double screens_differ = difference(on_screen(*views[i]), screens[i]);
      const QImage grabbed = views[i]->grab().toImage();
      qInfo("%s: %.3f %% of the pixels differ, %.3f %% on the screen", qPrintable(views[i]->title()),
            100.0 * differ, 100.0 * screens_differ);
      // The edges of letters are another painter's.
      QVERIFY(differ < 0.006);
      QVERIFY(screens_differ < 0.006);
      QVERIFY(difference(grabbed, screens[i]) < 0.006);
    }
    // Everything moves at once.
    WatchedApplication::instance().restart();
    desktop.proxy().play();
    for (int i = 0; i < 20; ++i) {
      desktop.proxy().display().change(
          [](engine::DisplaySettings& settings) { settings.camera.azimuth += 3.0; });
      QTest::qWait(20);
    }
    QTest::qWait(300);
    qInfo("%s: the user interface was late by %.0f ms at most", way,
          WatchedApplication::instance().longest_ms());
    desktop.proxy().pause();
    desktop.wait_until_idle();
    QCOMPARE(desktop.pictures_read_back() == 0, textures);
    QCOMPARE(desktop.engine().contexts_made(), 1);
  }
}

void PictureSurfaceTest::views_survive_being_undocked_docked_and_put_into_tabs() {
  DesktopWith desktop("textures");
  open_sphere(desktop);
  ui::CaseWindow& window = *desktop.window().active_case();
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  auto* volume = desktop.view<ui::VolumeViewWidget>();
  QVERIFY(axial && volume);
  QDockWidget* dock = window.dock_of(axial);
  QDockWidget* other = window.dock_of(volume);
  for (int i = 0; i < 4; ++i) {
    dock->setFloating(true);
    desktop.wait_until_idle();
    dock->setFloating(false);
    window.tabifyDockWidget(other, dock);
    other->raise();
    QTest::qWait(10);
    dock->raise();
    desktop.wait_until_idle();
    // The size is a new one each time; what is compared is the screen with a picture painted anew.
    QVERIFY(difference(on_screen(*axial), axial->grab_picture()) < 0.006);
    QVERIFY(axial->feed().shown().texture);
  }
  other->raise();
  desktop.wait_until_idle();
  QVERIFY(difference(on_screen(*volume), volume->grab_picture()) < 0.006);
  desktop.window().resize(900, 600);
  desktop.wait_until_idle();
  QVERIFY(volume->feed().shown().texture->size() == volume->physical_size());
  for (ui::PictureView* view :
       {static_cast<ui::PictureView*>(axial), static_cast<ui::PictureView*>(volume)}) {
    QCOMPARE(view->surface()->times_initialised(), 1);
  }
  QCOMPARE(desktop.engine().contexts_made(), 1);
  QCOMPARE(desktop.pictures_read_back(), 0);
}

void PictureSurfaceTest::the_mouse_and_the_keyboard_reach_the_view() {
  DesktopWith desktop("textures");
  open_sphere(desktop);
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  QVERIFY(axial);
  const QPoint middle = axial->rect().center();
  // Through the window, so that Qt decides whose the click is.
  QWidget& window = *axial->window();
  QWidget* under_mouse = QApplication::widgetAt(axial->mapToGlobal(middle));
  QVERIFY2(under_mouse == axial, under_mouse ? under_mouse->metaObject()->className() : "nothing");
  QTest::mouseClick(window.windowHandle(), Qt::LeftButton, {}, axial->mapTo(&window, middle));
  QTRY_VERIFY(axial->hasFocus());
  const glm::dvec3 before = desktop.proxy().display().settings().cursor_mm;
  QTest::keyClick(window.windowHandle(), Qt::Key_Up);
  QTRY_VERIFY(desktop.proxy().display().settings().cursor_mm != before);
}

void PictureSurfaceTest::a_texture_that_somebody_holds_is_not_drawn_into() {
  DesktopWith desktop("textures");
  open_sphere(desktop);
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  QVERIFY(axial);
  const std::shared_ptr<const engine::PictureTexture> held = axial->feed().shown().texture;
  std::set<unsigned> others;
  for (int i = 0; i < 10; ++i) {
    QTest::keyClick(axial, Qt::Key_Up);
    desktop.wait_until_idle();
    QVERIFY(axial->feed().shown().texture != held);
    others.insert(axial->feed().shown().texture->id());
  }
  QVERIFY(!others.contains(held->id()));
  // And there are not more than are needed.
  QVERIFY(others.size() <= 2);
}

void PictureSurfaceTest::a_lost_context_of_the_engine_costs_one_picture() {
  DesktopWith desktop("textures");
  open_sphere(desktop);
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  QVERIFY(axial);
  const QImage before = axial->grab_picture();
  const std::uint64_t number = axial->feed().shown().number;
  engine::Engine& engine = desktop.engine();
  engine.post(engine::Priority::edit, this,
              [&engine](const std::stop_token&) { engine.device()->lose_at_check(1); });
  QTest::keyClick(axial, Qt::Key_Up);
  QTRY_COMPARE(engine.contexts_made(), 2);
  desktop.wait_until_idle();
  QTest::keyClick(axial, Qt::Key_Down);
  desktop.wait_until_idle();
  QVERIFY(axial->feed().shown().number > number);
  QVERIFY(axial->feed().shown().texture);
  QVERIFY(difference(axial->grab_picture(), before) < 0.01);
  QCOMPARE(axial->surface()->times_initialised(), 1);
}

void PictureSurfaceTest::a_case_is_closed_while_its_pictures_are_drawn() {
  DesktopWith desktop("textures");
  open_sphere(desktop);
  ui::CaseWindow* first = desktop.window().active_case();
  const ui::PictureView* view = desktop.view<ui::VolumeViewWidget>();
  QVERIFY(view);
  // After its last holder it is destroyed on the engine's thread.
  std::shared_ptr<const engine::PictureTexture> held = view->feed().shown().texture;
  open_sphere(desktop);
  first->proxy().play();
  QTest::qWait(50);
  first->close_saved();
  QTRY_COMPARE(desktop.window().cases().size(), qsizetype{1});
  held.reset();
  auto* other = desktop.view<ui::VolumeViewWidget>();
  QVERIFY(other);
  desktop.wait_until_idle();
  QVERIFY(difference(on_screen(*other), other->grab_picture()) < 0.006);
  QCOMPARE(desktop.engine().contexts_made(), 1);
}

TIDEMARK_TEST(PictureSurfaceTest)

}  // namespace tidemark::test::picture_surface_test

#include "picture_surface_test.moc"
