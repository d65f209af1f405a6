// How many steps come between two pictures: so few that they are seen as motion.
#include "engine/step_schedule.h"

#include <chrono>
#include <thread>

#include "tests/support/test_program.h"

namespace tidemark::test::step_schedule_test {

using engine::StepSchedule;

namespace {

// A surface that moves by so much in a step, as of the report before the newest.
StepSchedule schedule_of(double voxels_per_step) {
  StepSchedule schedule;
  schedule.restart();
  for (int report = 0; report < 2; ++report) schedule.moved(voxels_per_step);
  return schedule;
}

// Pictures take at least so long.
void draw(StepSchedule& schedule, std::chrono::milliseconds time) {
  schedule.end_steps();
  std::this_thread::sleep_for(time);
  schedule.begin_steps();
}

int steps(const StepSchedule& schedule, double seconds_per_step) {
  return static_cast<int>(schedule.steps_to_next_picture(seconds_per_step));
}

}  // namespace

class StepScheduleTest : public QObject {
  Q_OBJECT

 private slots:
  void motion_is_seen() {
    QCOMPARE(steps(schedule_of(0.0), 1e-5), 50);
    QCOMPARE(steps(schedule_of(0.1), 1e-5), 80);
    QCOMPARE(steps(schedule_of(1.0), 1e-5), 50);
    QCOMPARE(steps(schedule_of(1e-6), 1e-5), 500);
  }

  void the_solver_gets_more_time_once_it_was_seen_how_the_surface_sets_out() {
    StepSchedule schedule = schedule_of(0.1);
    for (int run = 0; run < 5; ++run) {
      QCOMPARE(steps(schedule, 1e-5), 80);
      schedule.end_steps();
    }
    QCOMPARE(steps(schedule, 1e-5), 80);
    schedule.end_steps();
    QCOMPARE(steps(schedule, 1e-5), 120);
    for (int run = 0; run < 20; ++run) schedule.end_steps();
    QCOMPARE(steps(schedule, 1e-5), 500);
    QCOMPARE(steps(schedule, 1e-3), 48);  // 20 pictures a second
    schedule.restart();
    for (int report = 0; report < 2; ++report) schedule.moved(0.1);
    QCOMPARE(steps(schedule, 1e-5), 80);
  }

  void slow_steps_are_seen_one_by_one() {
    QCOMPARE(steps(schedule_of(0.1), 1.0), 1);
    QCOMPARE(steps(schedule_of(0.1), 0.012), 4);  // of 48 ms
    QCOMPARE(steps(schedule_of(0.1), 0.0), 1);    // nobody knows how long one takes
  }

  void slow_pictures_leave_steps_their_least_time() {
    StepSchedule schedule = schedule_of(1e-6);
    draw(schedule, std::chrono::milliseconds(60));
    QCOMPARE(steps(schedule, 1e-3), 16);
    QCOMPARE(steps(schedule_of(1e-6), 1e-3), 48);
  }

  void a_pace_goes_before_everything() {
    StepSchedule schedule = schedule_of(0.16);
    schedule.set(1000.0);
    draw(schedule, std::chrono::milliseconds(5));
    QCOMPARE(steps(schedule, 1e-5), 16);
    schedule.set_steps_per_picture(2);
    QCOMPARE(steps(schedule, 1e-5), 2);
  }
};

TIDEMARK_TEST(StepScheduleTest)

}  // namespace tidemark::test::step_schedule_test

#include "step_schedule_test.moc"
