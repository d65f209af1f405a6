// The menu of a view, by right clicks and by key, and that a right drag is none.
#include <QMenu>
#include <QSignalSpy>
#include <glm/geometric.hpp>

#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"

namespace tidemark::test::view_menu_story_test {

class ViewMenuStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void init();
  void cleanup() { desktop_.reset(); }
  void a_right_click_offers_what_can_be_done_here();
  void a_probe_takes_the_values_that_the_level_set_sees();
  void a_right_drag_zooms_and_opens_nothing();
  void the_keys_for_menus_open_it();
  void a_brush_keeps_its_right_button();
  void a_sphere_is_taken_away_by_a_drag();
  void in_3d_the_surface_is_a_place();

 private:
  static void right_click(QWidget& widget, QPoint at);
  static QMenu* menu();
  // By its text, in the menu or one of its submenus; null: there is none.
  static QAction* entry(QMenu& menu, const QString& text);
  // Clicks it, in a submenu too.
  void choose(const QString& text);
  [[nodiscard]] const engine::DisplaySettings& settings() { return desktop_->proxy().display().settings(); }
  [[nodiscard]] QPoint at(glm::dvec3 patient_mm) const { return axial_->position_of(patient_mm).toPoint(); }

  std::unique_ptr<Desktop> desktop_;
  ui::SliceViewWidget* axial_ = nullptr;
};

void ViewMenuStoryTest::init() {
  desktop_ = std::make_unique<Desktop>(story_executor(), QSize(1100, 700));
  QVERIFY(desktop_->open_phantom("dumbbell"));
  axial_ = desktop_->view<ui::SliceViewWidget>("Axial");
  QVERIFY(axial_);
}

void ViewMenuStoryTest::right_click(QWidget& widget, QPoint at) {
  QWidget& window = *widget.window();
  const QPoint there = widget.mapTo(&window, at);
  QTest::mouseMove(window.windowHandle(), there);
  QTest::mouseClick(window.windowHandle(), Qt::RightButton, {}, there);
}

QMenu* ViewMenuStoryTest::menu() {
  const bool opened = QTest::qWaitFor([] { return QApplication::activePopupWidget() != nullptr; }, 3000);
  if (!opened) return nullptr;
  return qobject_cast<QMenu*>(QApplication::activePopupWidget());
}

QAction* ViewMenuStoryTest::entry(QMenu& menu, const QString& text) {
  for (QAction* action : menu.actions()) {
    if (action->text().remove('&') == text) return action;
    QAction* deeper = action->menu() ? entry(*action->menu(), text) : nullptr;
    if (deeper) return deeper;
  }
  return nullptr;
}

void ViewMenuStoryTest::choose(const QString& text) {
  QMenu* shown = menu();
  QVERIFY(shown);
  QAction* wanted = entry(*shown, text);
  QVERIFY2(wanted && wanted->isEnabled(), qPrintable(text));
  if (!shown->actions().contains(wanted)) {
    for (QAction* action : shown->actions()) {
      if (!action->menu() || !action->menu()->actions().contains(wanted)) continue;
      QTest::mouseClick(shown, Qt::LeftButton, {}, shown->actionGeometry(action).center());
      shown = action->menu();
      QVERIFY(Desktop::wait_for([&] { return shown->isVisible(); }));
      break;
    }
  }
  QTest::mouseClick(shown, Qt::LeftButton, {}, shown->actionGeometry(wanted).center());
  desktop_->wait_until_idle();
  QVERIFY(!QApplication::activePopupWidget());
}

void ViewMenuStoryTest::a_right_click_offers_what_can_be_done_here() {
  const glm::dvec3 seed = desktop_->seed_mm();
  const glm::dvec3 beside = seed + glm::dvec3(9.0, -6.0, 0.0);
  right_click(*axial_, at(beside));
  QVERIFY(menu());
  desktop_->screenshot_at_once("menu-1-slice");
  for (const char* text :
       {"Window and level", "Overlays", "Large, or back", "Reset views", "Picture of the view…"})
    QVERIFY2(entry(*menu(), text), text);
  choose("Show this place in all views");
  QVERIFY(glm::distance(settings().cursor_mm, beside) < 1.0);

  right_click(*axial_, at(seed));
  choose("Place a sphere here");
  QVERIFY(desktop_->state().begun);
  const double radius = settings().brush_mm;
  const double ball_ml = 4.0 / 3.0 * M_PI * radius * radius * radius / 1000.0;
  QVERIFY2(std::abs(desktop_->state().surface.volume_ml / ball_ml - 1.0) < 0.1,
           qPrintable(QString::number(desktop_->state().surface.volume_ml)));

  solver::Parameters off = desktop_->proxy().parameters();
  off.target = 20.0;
  desktop_->proxy().set_parameters(off);
  right_click(*axial_, at(seed));
  choose("Probe T and ε here");
  QVERIFY2(std::abs(desktop_->state().parameters.target - desktop_->proxy().study().parameters.target) < 60.0,
           qPrintable(QString::number(desktop_->state().parameters.target)));

  const WindowLevel before = settings().window;
  right_click(*axial_, at(seed));
  choose("Full range");
  QVERIFY(settings().window != before);
  right_click(*axial_, at(seed));
  choose("Outline of the surface");
  QVERIFY(!settings().outline);
  right_click(*axial_, at(seed));
  choose("Reset views");
  QVERIFY(settings().window == before);

  const QSize small = axial_->size();
  right_click(*axial_, at(seed));
  choose("Large, or back");
  QVERIFY(axial_->height() > small.height());
  right_click(*axial_, at(seed));
  choose("Large, or back");
  QVERIFY(Desktop::wait_for([&] { return axial_->size() == small; }));
}

void ViewMenuStoryTest::a_probe_takes_the_values_that_the_level_set_sees() {
  QVERIFY(desktop_->open_phantom("tumour"));  // which is noisy
  axial_ = desktop_->view<ui::SliceViewWidget>("Axial");
  QVERIFY(axial_);
  const auto probed_range = [&] {
    right_click(*axial_, at(desktop_->seed_mm()));
    choose("Probe T and ε here");
    return desktop_->state().parameters.range;
  };
  const double of_noise = probed_range();
  desktop_->proxy().smooth_source(2.0);
  QVERIFY(Desktop::wait_for([&] { return desktop_->state().smoothed_mm == 2.0; }));
  const double smoothed = probed_range();
  QVERIFY2(smoothed < 0.7 * of_noise, qPrintable(QStringLiteral("%1, then %2").arg(of_noise).arg(smoothed)));
}

void ViewMenuStoryTest::a_right_drag_zooms_and_opens_nothing() {
  desktop_->press(Qt::Key_W);
  const QSignalSpy wanted(axial_, &ui::PictureView::menu_wanted);
  const double zoom = settings().slice_zoom;
  const QPoint from = axial_->rect().center();
  Desktop::drag(static_cast<QWidget&>(*axial_), {from, from - QPoint(0, 3), from - QPoint(0, 20), from},
                Qt::RightButton);  // and back to where it began
  QTest::qWait(100);
  QCOMPARE(wanted.size(), 0);
  QVERIFY(!QApplication::activePopupWidget());
  Desktop::drag(static_cast<QWidget&>(*axial_), {from, from - QPoint(0, 20), from - QPoint(0, 40)},
                Qt::RightButton);
  QVERIFY(settings().slice_zoom > 1.2 * zoom);
  QCOMPARE(wanted.size(), 0);

  // A hand that shakes a little does not zoom.
  const double now = settings().slice_zoom;
  Desktop::drag(static_cast<QWidget&>(*axial_), {from, from + QPoint(1, 2)}, Qt::RightButton);
  QVERIFY(menu());
  QCOMPARE(settings().slice_zoom, now);
  QTest::keyClick(menu(), Qt::Key_Escape);
  QVERIFY(!QApplication::activePopupWidget());
}

void ViewMenuStoryTest::the_keys_for_menus_open_it() {
  axial_->setFocus();
  QTest::keyClick(desktop_->window().windowHandle(), Qt::Key_F10, Qt::ShiftModifier);
  QVERIFY(menu());
  const QPoint middle = axial_->mapToGlobal(at(settings().cursor_mm));
  QVERIFY((menu()->pos() - middle).manhattanLength() < 8);
  QTest::keyClick(menu(), Qt::Key_Escape);
  QVERIFY(!QApplication::activePopupWidget());
  QTest::keyClick(desktop_->window().windowHandle(), Qt::Key_Menu);
  QVERIFY(menu());
  // By arrows, to the sphere.
  QTest::keyClick(menu(), Qt::Key_Down);
  QTest::keyClick(menu(), Qt::Key_Down);
  QTest::keyClick(menu(), Qt::Key_Return);
  desktop_->wait_until_idle();
  QVERIFY(desktop_->state().begun);
}

void ViewMenuStoryTest::a_brush_keeps_its_right_button() {
  desktop_->begin(14.0);
  const double before = desktop_->state().surface.volume_ml;
  desktop_->press(Qt::Key_B);
  right_click(*axial_, at(desktop_->seed_mm()));
  desktop_->wait_until_idle();
  QVERIFY(!QApplication::activePopupWidget());
  QVERIFY(desktop_->state().surface.volume_ml < before);
}

void ViewMenuStoryTest::a_sphere_is_taken_away_by_a_drag() {
  desktop_->begin(20.0);
  const double before = desktop_->state().surface.volume_ml;
  desktop_->press(Qt::Key_S);
  right_click(*axial_, at(desktop_->seed_mm()));
  QVERIFY(menu());
  QTest::keyClick(menu(), Qt::Key_Escape);
  desktop_->wait_until_idle();
  QCOMPARE(desktop_->state().surface.volume_ml, before);
  const glm::dvec3 seed = desktop_->seed_mm();
  Desktop::drag(*axial_, {seed, seed + glm::dvec3(6.0, 0.0, 0.0), seed + glm::dvec3(10.0, 0.0, 0.0)},
                Qt::RightButton);
  desktop_->wait_until_idle();
  QVERIFY(desktop_->state().surface.volume_ml < 0.95 * before);
}

void ViewMenuStoryTest::in_3d_the_surface_is_a_place() {
  desktop_->begin(24.0);
  auto* volume = desktop_->view<ui::VolumeViewWidget>();
  QVERIFY(volume);
  desktop_->proxy().step();  // so that nothing covers it
  desktop_->wait_until_idle();
  const glm::dvec3 seed = desktop_->seed_mm();
  desktop_->proxy().display().change([](engine::DisplaySettings& s) { s.cursor_mm += glm::dvec3(40.0); });
  right_click(*volume, volume->position_of(seed).toPoint());
  QVERIFY(menu());
  desktop_->screenshot_at_once("menu-2-3d");
  choose("Show this place in all views");
  QVERIFY2(std::abs(glm::distance(settings().cursor_mm, seed) - 24.0) < 3.0,
           qPrintable(QString::number(glm::distance(settings().cursor_mm, seed))));
  right_click(*volume, {4, volume->height() - 4});
  QVERIFY(menu());
  QVERIFY(!entry(*menu(), "Place a sphere here")->isEnabled());
  QTest::keyClick(menu(), Qt::Key_Escape);
}

TIDEMARK_TEST(ViewMenuStoryTest)

}  // namespace tidemark::test::view_menu_story_test

#include "view_menu_story_test.moc"
