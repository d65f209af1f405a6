// What counts as motion of a page: a front that goes on, however slowly, and not what flickers.
#include "solver/convergence.h"
#include "tests/support/test_program.h"

namespace tidemark::test::motion_watch_test {

namespace {

constexpr double kTimeStep = 0.25;
constexpr double kNear = 2.0;  // the largest spacing by the smallest

solver::RestRule rule(double data_weight = 1.0) {
  return solver::RestRule::of(kTimeStep, data_weight, kNear, 512);
}

// `volume`: inside of the page, in voxels.
solver::PageContent content_of(double volume) {
  constexpr double kNearVoxels = 128.0;
  return {2.0 * kNear * volume * solver::kMotionSamples, kNearVoxels * solver::kMotionSamples,
          solver::kMotionSamples};
}

// A page of 8^3 voxels, of which 100 + more(window) are inside.
struct Page {
  solver::MotionWatch watch;
  solver::PageRest rest;

  explicit Page(double data_weight = 1.0) { watch.restart(rule(data_weight)); }

  template <class More>
  void show(int windows, More more) {
    for (int i = 0; i < windows; ++i) {
      watch.add_page(content_of(100.0 + more(i)), rest);
      watch.end_window();
    }
  }
};

}  // namespace

class MotionWatchTest : public QObject {
  Q_OBJECT

 private slots:
  void what_rests_is_at_rest_after_the_time_to_rest() {
    Page page;
    const int windows = rule().windows_to_rest;
    page.show(windows, [](int) { return 0.0; });
    QVERIFY(!page.watch.rests());
    page.show(1, [](int) { return 0.0; });
    QVERIFY(page.watch.rests());
    QCOMPARE(page.watch.speed(), 0.0);
  }

  void two_voxels_in_the_time_to_rest_are_motion_and_a_half_is_none() {
    for (const double alpha : {0.0, 0.1, 0.25, 0.5, 1.0}) {
      const double voxels_a_window =
          rule().window_time * std::max(alpha, 0.25) / solver::kRestTime;  // one in the time to rest
      for (const double factor : {2.0, 0.4}) {
        Page page(alpha);
        int moving = 0;
        for (int i = 0; i < 200; ++i) {
          page.show(1, [&](int) { return factor * voxels_a_window * i; });
          if (i >= 100 && !page.watch.rests()) ++moving;
        }
        if (factor > 1.0) {
          QCOMPARE(moving, 100);
          QCOMPARE(page.watch.moving_pages(), 1);
          // Each of the 128 voxels beside the surface changes by as much.
          const double speed = 2.0 * kNear * factor * voxels_a_window / 128.0 / rule().window_time;
          QVERIFY(std::abs(page.watch.speed() - speed) < 1e-3 * speed);
        } else {
          QVERIFY2(moving < 60, qPrintable(QString("alpha %1: %2").arg(alpha).arg(moving)));
        }
      }
    }
  }

  void what_flickers_rests_whatever_its_period_is() {
    for (const int period : {2, 3, 5, 7, 16, 37}) {
      Page page;
      page.show(400, [&](int i) { return 0.45 * std::sin(2.0 * 3.14159265 * i / period); });
      QVERIFY2(page.watch.rests(), qPrintable(QString::number(period)));
    }
  }

  void a_page_that_came_within_the_window_is_not_judged_by_it() {
    Page page;
    page.show(10, [](int) { return 0.0; });
    solver::PageContent part = content_of(500.0);
    part.samples = solver::kMotionSamples - 1;
    page.watch.add_page(part, page.rest);
    page.watch.end_window();
    QVERIFY(page.watch.rests());
  }

  void a_restart_forgets_what_moved() {
    Page page;
    page.show(10, [](int i) { return 10.0 * i; });
    QVERIFY(page.watch.is_moving(page.rest));
    page.watch.restart(rule());
    QVERIFY(!page.watch.is_moving(page.rest));
    const int windows = rule().windows_to_rest;
    page.show(windows, [](int) { return 50.0; });
    QVERIFY(!page.watch.rests());
    page.show(1, [](int) { return 50.0; });
    QVERIFY(page.watch.rests());
  }

  void one_page_that_moves_keeps_the_others_company() {
    Page page;
    solver::PageRest others[3];
    for (int i = 0; i < 50; ++i) {
      for (solver::PageRest& other : others) page.watch.add_page(content_of(300.0), other);
      page.show(1, [&](int) { return 1.2 * i; });
    }
    QVERIFY(!page.watch.rests());
    QCOMPARE(page.watch.moving_pages(), 1);
    QVERIFY(page.watch.is_moving(page.rest));
    QVERIFY(!page.watch.is_moving(others[0]));
  }
};

TIDEMARK_TEST(MotionWatchTest)

}  // namespace tidemark::test::motion_watch_test

#include "motion_watch_test.moc"
