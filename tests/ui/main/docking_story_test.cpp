// Views float, return, tab and move between windows, and show the same pictures afterwards.
#include <QApplication>
#include <QDockWidget>
#include <QFile>
#include <QMdiSubWindow>
#include <QSlider>
#include <QToolButton>
#include <map>

#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "ui/main/panel_docks.h"

namespace tidemark::test::docking_story_test {

class DockingStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void fifty_moves_change_no_picture_and_cost_no_context();
  void every_layout_shows_its_views();
  void a_view_is_maximised_by_a_double_click_and_back();
  void a_closed_view_comes_back();
  void views_that_nobody_sees_take_no_time_from_the_surface();
  void a_case_behind_another_is_not_drawn();
  void views_keep_their_shares_of_a_window();
  void a_session_brings_back_all_views_data();
  void a_session_brings_back_all_views();
  void a_panel_rests_behind_a_tab_and_keeps_its_size();
  void a_panel_in_a_window_of_its_own_keeps_its_keys();

 private:
  static QList<QImage> pictures(ui::CaseWindow& window);
  static QList<ui::PictureView*> visible(ui::CaseWindow& window);
};

QList<ui::PictureView*> DockingStoryTest::visible(ui::CaseWindow& window) {
  QList<ui::PictureView*> visible;
  for (ui::PictureView* view : window.views()) {
    if (view->isVisible()) visible << view;
  }
  return visible;
}

QList<QImage> DockingStoryTest::pictures(ui::CaseWindow& window) {
  QList<QImage> pictures;
  for (ui::PictureView* view : window.views()) pictures << view->grab_picture();
  return pictures;
}

void DockingStoryTest::views_keep_their_shares_of_a_window() {
  Desktop desktop(solver::ExecutorKind::host, {1280, 800});
  auto* first = desktop.open_phantom("sphere");
  const auto shares = [&] {
    desktop.wait_until_idle();
    QList<QPointF> all;
    for (ui::PictureView* view : visible(*first))
      all << QPointF(double(view->width()) / first->width(), double(view->height()) / first->height());
    return all;
  };
  const QList<QPointF> before = shares();
  QCOMPARE(before.size(), qsizetype{3});
  // Beside a second one it has half of the room, and what is written over 3D stays inside.
  auto* second = desktop.open_phantom("dumbbell");
  desktop.window().bring_to_front(*first);
  desktop.wait_until_idle();
  desktop.screenshot("docking-two-cases");
  QVERIFY(first->width() < 500);
  auto* solid = desktop.view<ui::VolumeViewWidget>();
  auto* hint = seen<QAbstractButton>(*solid, "Sphere tool")->parentWidget();
  QVERIFY(solid->rect().contains(QRect(hint->mapTo(solid, QPoint()), hint->size())));
  second->parentWidget()->close();
  QVERIFY(Desktop::wait_for([&] { return first->width() > 700; }));
  const QList<QPointF> after = shares();
  QCOMPARE(after.size(), before.size());
  for (qsizetype n = 0; n < before.size(); ++n) {
    const QPointF change = after[n] - before[n];
    QVERIFY2(std::abs(change.x()) < 0.03 && std::abs(change.y()) < 0.03,
             qPrintable(QStringLiteral("%1: %2, %3").arg(n).arg(change.x()).arg(change.y())));
  }
}

void DockingStoryTest::a_session_brings_back_all_views_data() {
  QTest::addColumn<QList<int>>("keys");
  QTest::addColumn<bool>("maximised");
  QTest::newRow("two by two") << QList<int>{Qt::Key_3} << false;
  QTest::newRow("two by two, one of them large") << QList<int>{Qt::Key_3} << true;
  QTest::newRow("one large, three small") << QList<int>{Qt::Key_2} << false;
  QTest::newRow("after several layouts") << QList<int>{Qt::Key_2, Qt::Key_4, Qt::Key_1, Qt::Key_3} << true;
}

void DockingStoryTest::a_session_brings_back_all_views() {
  QFETCH(QList<int>, keys);
  QFETCH(bool, maximised);
  Desktop desktop(solver::ExecutorKind::host, {1000, 700});
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.begin(10.0);
  for (const int key : keys) {
    desktop.press(static_cast<Qt::Key>(key), Qt::ControlModifier);
    desktop.wait_until_idle();
  }
  const auto places = [&] {
    QStringList texts;
    ui::CaseWindow& window = *desktop.window().active_case();
    for (ui::PictureView* view : visible(window)) {
      const QRect place = window.dock_of(view)->geometry();
      texts << QStringLiteral("%1: %2, %3").arg(view->title()).arg(place.x()).arg(place.y());
    }
    texts.sort();
    return texts.join("; ");
  };
  const QString before = places();
  QVERIFY(before.contains("Sagittal"));
  if (maximised) {
    desktop.press(Qt::Key_W);  // a double click of the sphere tool places two
    auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
    QTest::mouseDClick(axial, Qt::LeftButton, {}, axial->rect().center());
    QVERIFY(Desktop::wait_for([&] { return visible(*desktop.window().active_case()).size() == 1; }));
  }
  const TemporaryFolder folder;
  const QString file = QString::fromStdString((folder / "case.tidemark").string());
  desktop.window().active_case()->session_file = file;
  desktop.press(Qt::Key_S, Qt::ControlModifier);
  QVERIFY(Desktop::wait_for([&] { return QFile::exists(file) && !desktop.state().modified; }));
  desktop.press(Qt::Key_W, Qt::ControlModifier);
  QVERIFY(Desktop::wait_for([&] { return desktop.window().cases().isEmpty(); }));
  QVERIFY(desktop.open(file));
  QCOMPARE(places(), before);
}

void DockingStoryTest::fifty_moves_change_no_picture_and_cost_no_context() {
  Desktop desktop(story_executor(), {1000, 700});
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.begin(10.0);
  ui::CaseWindow& window = *desktop.window().active_case();
  window.set_layout(ui::ViewLayout::paper);
  desktop.wait_until_idle();
  const QList<QImage> before = pictures(window);
  const QList<ui::PictureView*> views = window.views();
  QCOMPARE(views.size(), 3);
  auto* child = qobject_cast<QMdiSubWindow*>(window.parentWidget());
  QVERIFY(child);

  ui::Actions& actions = desktop.window().actions();
  for (int round = 0; round < 50; ++round) {
    ui::PictureView* view = views[round % 3];
    QDockWidget* dock = window.dock_of(view);
    QDockWidget* other = window.dock_of(views[(round + 1) % 3]);
    dock->setFloating(true);
    QTest::qWait(10);
    QVERIFY(dock->isWindow());
    if (round % 10 == 0) {
      desktop.wait_until_idle();
      QVERIFY(shows_a_picture(*view));
    }
    dock->setFloating(false);
    window.tabifyDockWidget(other, dock);
    QTest::qWait(5);
    window.addDockWidget(Qt::LeftDockWidgetArea, dock, round % 2 == 0 ? Qt::Horizontal : Qt::Vertical);
    actions.tabs->toggle();
    round % 2 == 0 ? actions.tile->trigger() : actions.cascade->trigger();
    QTest::qWait(5);
    child->showMaximized();
    if (round % 10 == 9) {
      desktop.wait_until_idle();
      for (const ui::PictureView* each : views) {
        QVERIFY2(shows_a_picture(*each), qPrintable(QString("%1: %2, %3 x %4")
                                                        .arg(round)
                                                        .arg(each->title())
                                                        .arg(each->width())
                                                        .arg(each->height())));
      }
    }
  }
  window.set_layout(ui::ViewLayout::paper);
  desktop.wait_until_idle();
  QCOMPARE(window.views(), views);
  const QList<QImage> after = pictures(window);
  for (qsizetype index = 0; index < before.size(); ++index) {
    QCOMPARE(after[index].size(), before[index].size());
    QVERIFY2(difference(after[index], before[index]) < 0.005,
             qPrintable(QString::number(difference(after[index], before[index]))));
  }
  QCOMPARE(desktop.engine().contexts_made(), 1);
}

void DockingStoryTest::every_layout_shows_its_views() {
  Desktop desktop(story_executor(), {1000, 700});
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.begin(10.0);
  ui::CaseWindow& window = *desktop.window().active_case();
  const QList<int> views{1, 4, 4, 3};
  const QList<QAction*> layouts = desktop.window().actions().layouts->actions();
  QCOMPARE(layouts.size(), views.size());
  for (const int layout : {0, 1, 2, 3, 1, 0, 3, 2}) {
    desktop.press(static_cast<Qt::Key>(Qt::Key_1 + layout), Qt::ControlModifier);
    desktop.wait_until_idle();
    QCOMPARE(static_cast<int>(window.view_layout()), layout);
    QCOMPARE(visible(window).size(), views[layout]);
    for (const ui::PictureView* view : visible(window)) {
      QVERIFY2(shows_a_picture(*view), qPrintable(QString("%1: %2").arg(layout).arg(view->title())));
      QVERIFY(view->width() >= 120 && view->height() >= 100);
    }
  }
}

void DockingStoryTest::a_view_is_maximised_by_a_double_click_and_back() {
  Desktop desktop(story_executor(), {1000, 700});
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.press(Qt::Key_W);  // a double click of the sphere tool places two
  desktop.begin(10.0);
  ui::CaseWindow& window = *desktop.window().active_case();
  window.set_layout(ui::ViewLayout::two_two);
  desktop.wait_until_idle();
  for (ui::PictureView* view : visible(window)) {
    const QSize small = view->size();
    const QImage before = view->grab_picture();
    QTest::mouseDClick(view, Qt::LeftButton, {}, view->rect().center() + QPoint(30, 30));
    desktop.wait_until_idle();
    QCOMPARE(visible(window).size(), 1);
    QVERIFY(view->width() > small.width() + 100 && view->height() > small.height() + 100);
    QVERIFY(shows_a_picture(*view));
    QTest::mouseDClick(view, Qt::LeftButton, {}, view->rect().center() + QPoint(30, 30));
    desktop.wait_until_idle();
    QCOMPARE(visible(window).size(), 4);
    QCOMPARE(view->size(), small);
    QVERIFY(difference(view->grab_picture(), before) < 0.005);
  }
}

void DockingStoryTest::a_closed_view_comes_back() {
  Desktop desktop(story_executor(), {1000, 700});
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.begin(10.0);
  ui::CaseWindow& window = *desktop.window().active_case();
  window.set_layout(ui::ViewLayout::paper);
  desktop.wait_until_idle();
  for (const ui::ViewKind kind : {ui::ViewKind::volume, ui::ViewKind::axial, ui::ViewKind::speed}) {
    const qsizetype views = window.views().size();
    ui::PictureView* view = window.add_view(kind);  // beside the first of its kind
    desktop.wait_until_idle();
    QCOMPARE(window.views().size(), views + 1);
    window.dock_of(view)->close();
    desktop.wait_until_idle();
    QVERIFY(!view->isVisible());
    // What happens meanwhile is seen when it is back.
    desktop.proxy().step(5);
    desktop.wait_until_idle();
    QCOMPARE(window.add_view(kind), view);
    desktop.wait_until_idle();
    QVERIFY(view->isVisible());
    QVERIFY(shows_a_picture(*view));
    QCOMPARE(view->feed().shown().step, desktop.state().step);
  }
  // Nothing is shown when all are closed, and nothing breaks.
  for (ui::PictureView* view : window.views()) window.dock_of(view)->close();
  desktop.wait_until_idle();
  QVERIFY(!window.active_view());
  QVERIFY(window.add_view(ui::ViewKind::volume));
  desktop.wait_until_idle();
  QVERIFY(window.active_view());
  QVERIFY(shows_a_picture(*window.active_view()));
}

void DockingStoryTest::a_case_behind_another_is_not_drawn() {
  Desktop desktop(story_executor(), {1200, 760});
  QList<ui::CaseWindow*> cases;
  for (const char* kind : {"sphere", "dumbbell"}) {
    cases << desktop.open_phantom(kind);
    desktop.begin(8.0);
  }
  const auto pictures_of = [](ui::CaseWindow& window) {
    std::uint64_t count = 0;
    for (const ui::PictureView* view : window.views()) count += view->feed().shown().number;
    return count;
  };
  const auto turn = [](ui::CaseWindow& window) {
    window.proxy().display().change([](engine::DisplaySettings& settings) {
      settings.camera.azimuth += 20.0;
      settings.cursor_mm.z += 1.0;
    });
  };
  desktop.window().actions().tabs->setChecked(true);
  desktop.window().bring_to_front(*cases[1]);
  desktop.wait_until_idle();
  const std::uint64_t before = pictures_of(*cases[0]);
  turn(*cases[0]);
  desktop.wait_until_idle();
  QCOMPARE(pictures_of(*cases[0]), before);
  // Where one of its views has a window of its own, it is seen.
  ui::PictureView* floating = cases[0]->views().last();
  cases[0]->dock_of(floating)->setFloating(true);
  desktop.wait_until_idle();
  const std::uint64_t of_floating = floating->feed().shown().number;
  turn(*cases[0]);
  desktop.wait_until_idle();
  QVERIFY(floating->feed().shown().number > of_floating);
  cases[0]->dock_of(floating)->setFloating(false);
  // In front, or beside the other, it is there as it is now.
  for (const bool tabs : {true, false}) {
    turn(*cases[0]);
    desktop.wait_until_idle();
    desktop.window().actions().tabs->setChecked(tabs);
    if (tabs) desktop.window().bring_to_front(*cases[0]);
    if (!tabs) desktop.window().actions().tile->trigger();
    desktop.wait_until_idle();
    for (const ui::PictureView* view : visible(*cases[0]))
      QVERIFY2(Desktop::wait_for([&] { return shows_a_picture(*view); }), qPrintable(view->title()));
    const std::uint64_t seen = pictures_of(*cases[0]);
    turn(*cases[0]);
    desktop.wait_until_idle();
    QVERIFY(pictures_of(*cases[0]) > seen);
  }
}

void DockingStoryTest::views_that_nobody_sees_take_no_time_from_the_surface() {
  Desktop desktop(story_executor(), {1000, 700});
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.begin(10.0);
  desktop.proxy().set_pause_at_convergence(false);
  desktop.press(Qt::Key_W);  // a double click of the sphere tool places two
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  auto* volume = desktop.view<ui::VolumeViewWidget>();
  const auto click_twice = [&] { QTest::mouseDClick(axial, Qt::LeftButton, {}, axial->rect().center()); };
  click_twice();
  ui::CaseWindow& window = *desktop.window().active_case();
  QVERIFY(Desktop::wait_for([&] { return visible(window).size() == 1; }));
  desktop.wait_until_idle();
  const auto number_of = [](const ui::PictureView* view) { return view->feed().shown().number; };
  std::map<ui::PictureView*, std::uint64_t> before;
  for (ui::PictureView* view : window.views()) before[view] = number_of(view);
  QCOMPARE(before.size(), std::size_t{3});
  // A finished picture in 3D is there again as it was.
  click_twice();
  QVERIFY(Desktop::wait_for([&] { return visible(window).size() == 3; }));
  desktop.wait_until_idle();
  QCOMPARE(number_of(volume), before[volume]);
  click_twice();
  QVERIFY(Desktop::wait_for([&] { return visible(window).size() == 1; }));
  desktop.wait_until_idle();
  for (ui::PictureView* view : window.views()) before[view] = number_of(view);
  desktop.press(Qt::Key_P);
  QVERIFY(Desktop::wait_for([&] { return number_of(axial) > before[axial] + 5; }));
  desktop.press(Qt::Key_P);
  QVERIFY(Desktop::wait_for([&] { return !desktop.state().playing; }));
  desktop.wait_until_idle();
  for (ui::PictureView* view : window.views()) {
    if (view != axial) QCOMPARE(number_of(view), before[view]);
  }
  // Back in sight they show what has become of it.
  click_twice();
  QVERIFY(Desktop::wait_for([&] { return visible(window).size() == 3; }));
  desktop.wait_until_idle();
  for (ui::PictureView* view : window.views()) {
    QCOMPARE(view->feed().shown().step, desktop.state().step);
    QVERIFY(shows_a_picture(*view));
  }
}

void DockingStoryTest::a_panel_rests_behind_a_tab_and_keeps_its_size() {
  Desktop desktop(story_executor(), {1400, 900});
  QVERIFY(desktop.open_phantom("sphere"));
  ui::MainWindow& window = desktop.window();
  auto* start = window.findChild<QDockWidget*>("initialise");
  auto* level_set = window.findChild<QDockWidget*>("level-set");
  desktop.wait_until_idle();
  QVERIFY(start->widget()->isVisible());
  QVERIFY(!level_set->widget()->isVisible());
  window.resizeDocks({start}, {460}, Qt::Horizontal);
  desktop.wait_until_idle();
  const int width = start->width();  // with the tabs beside it, as much as that
  QVERIFY2(width > 400, qPrintable(QString::number(width)));
  window.panels().show("level-set");
  QVERIFY(Desktop::wait_for([&] { return level_set->widget()->isVisible(); }));
  QVERIFY(!start->widget()->isVisible());
  QCOMPARE(level_set->width(), width);

  level_set->setFloating(true);
  level_set->resize(400, 700);
  window.panels().show("initialise");
  QVERIFY(Desktop::wait_for([&] { return start->widget()->isVisible(); }));
  QCOMPARE(level_set->size(), QSize(400, 700));
  QVERIFY(level_set->widget()->isVisible());
  for (const bool hidden : {true, false}) {
    window.actions().hide_interface->setChecked(hidden);
    QVERIFY(Desktop::wait_for([&] { return level_set->widget()->isVisible() == !hidden; }));
    QCOMPARE(start->widget()->isVisible(), !hidden);
  }
  desktop.wait_until_idle();
  QCOMPARE(level_set->size(), QSize(400, 700));
}

void DockingStoryTest::a_panel_in_a_window_of_its_own_keeps_its_keys() {
  Desktop desktop(solver::ExecutorKind::host, {1280, 800});
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.begin(10.0);
  desktop.proxy().step(3);
  desktop.window().panels().show("level-set");
  desktop.wait_until_idle();
  auto* dock = desktop.window().findChild<QDockWidget*>("level-set");
  dock->setFloating(true);
  QVERIFY(QTest::qWaitForWindowExposed(dock));
  dock->activateWindow();
  QVERIFY(QTest::qWaitForWindowActive(dock));
  desktop.wait_until_idle();
  auto* alpha = seen<QSlider>(*dock, "Data weight α");
  QVERIFY(alpha->value() > alpha->minimum());
  alpha->setFocus();
  QCOMPARE(QApplication::focusWidget(), alpha);
  QTest::keyClick(alpha, Qt::Key_Home);
  desktop.wait_until_idle();
  QCOMPARE(alpha->value(), alpha->minimum());
  QCOMPARE(desktop.state().step, std::int64_t{3});  // it did not begin again
  // The other keys are the main window's.
  QTest::keyClick(alpha, Qt::Key_Period);
  desktop.wait_until_idle();
  QCOMPARE(desktop.state().step, std::int64_t{4});
}

TIDEMARK_TEST(DockingStoryTest)

}  // namespace tidemark::test::docking_story_test

#include "docking_story_test.moc"
