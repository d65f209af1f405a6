// A leak: the alarm, where it is, and what can be done about it, by mouse and keys.
#include <QCheckBox>
#include <QPushButton>

#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "ui/main/message_bar.h"

namespace tidemark::test::leak_story_test {
namespace {

constexpr int kPatience = 60'000;  // ms
// The phantom: two balls of 20 mm around x = -28 and 28 mm, and a neck of 6 mm between them.
constexpr double kBallMl = 33.5;

}  // namespace

class LeakStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void init();
  void cleanup() { desktop_.reset(); }
  void a_wall_keeps_the_surface_in_the_first_ball();
  void going_back_and_a_smaller_alpha();
  void going_on_fills_both_balls();
  void the_alarm_can_be_switched_off();

 private:
  void play_into_the_neck();
  void wait_for_rest();
  void click(const QString& button);
  [[nodiscard]] ui::MessageBar& bar() const { return *desktop_->window().findChild<ui::MessageBar*>(); }
  [[nodiscard]] const engine::CaseState& state() const { return desktop_->state(); }

  std::unique_ptr<Desktop> desktop_;
};

void LeakStoryTest::init() {
  desktop_ = std::make_unique<Desktop>(story_executor(), QSize(1366, 768));
  QVERIFY(desktop_->open_phantom("dumbbell"));
  desktop_->begin(8.0);
  desktop_->wait_until_idle();
}

void LeakStoryTest::play_into_the_neck() {
  desktop_->press(Qt::Key_P);
  QVERIFY(Desktop::wait_for([&] { return state().leak && !state().playing; }, kPatience));
  desktop_->wait_until_idle();
  QVERIFY2(bar().text().contains("the surface leaks"), qPrintable(bar().text()));
  // The slices go through the neck.
  const glm::dvec3 cross = desktop_->proxy().display().settings().cursor_mm;
  QVERIFY2(std::abs(cross.x) < 14.0 && std::hypot(cross.y, cross.z) < 7.0,
           qPrintable(QString("%1 %2 %3").arg(cross.x).arg(cross.y).arg(cross.z)));
  QVERIFY(state().leak->before < state().step);
  QVERIFY(state().surface.volume_ml < 1.6 * kBallMl);
}

void LeakStoryTest::wait_for_rest() {
  QVERIFY(Desktop::wait_for([&] { return state().converged && !state().playing; }, kPatience));
  desktop_->wait_until_idle();
}

void LeakStoryTest::click(const QString& button) {
  for (QPushButton* offer : bar().findChildren<QPushButton*>()) {
    if (!offer->isVisible() || !offer->text().startsWith(button)) continue;
    QTest::mouseClick(offer, Qt::LeftButton);
    desktop_->wait_until_idle();
    return;
  }
  QFAIL(qPrintable("no button " + button));
}

void LeakStoryTest::a_wall_keeps_the_surface_in_the_first_ball() {
  play_into_the_neck();
  desktop_->screenshot("leak-1-alarm");
  click("Wall it off");
  wait_for_rest();
  QCOMPARE(bar().text(), QString());
  QVERIFY(!state().leak);
  QVERIFY(state().drive.constraints && !state().drive.constraints->empty());
  QVERIFY2(std::abs(state().surface.volume_ml / kBallMl - 1.0) < 0.08,
           qPrintable(QString::number(state().surface.volume_ml)));
  desktop_->screenshot("leak-2-walled-off");
}

void LeakStoryTest::going_back_and_a_smaller_alpha() {
  play_into_the_neck();
  const std::int64_t before = state().leak->before;
  const std::int64_t seen = state().step;
  click("Go back");
  QCOMPARE(state().step, before);
  QVERIFY(!state().leak && !state().playing);
  QCOMPARE(bar().text(), QString());
  // Undo leads back to where the alarm was.
  desktop_->press(Qt::Key_Z, Qt::ControlModifier);
  desktop_->wait_until_idle();
  QCOMPARE(state().step, seen);

  // From there no leak is new; a start anew leads to the next alarm.
  Desktop::in_an_event([&] { desktop_->proxy().restart(); });
  desktop_->wait_until_idle();
  play_into_the_neck();
  const double alpha = state().parameters.alpha;
  click("α");
  QVERIFY(state().parameters.alpha < 0.9 * alpha);
  QVERIFY(Desktop::wait_for([&] { return !state().playing; }, kPatience));
}

// The neck is a part of the body, if the user says so.
void LeakStoryTest::going_on_fills_both_balls() {
  play_into_the_neck();
  desktop_->press(Qt::Key_P);
  wait_for_rest();
  QVERIFY(!state().leak);
  QCOMPARE(bar().text(), QString());
  QVERIFY2(state().surface.volume_ml > 1.9 * kBallMl, qPrintable(QString::number(state().surface.volume_ml)));
}

void LeakStoryTest::the_alarm_can_be_switched_off() {
  QCheckBox* leaks = nullptr;
  for (QCheckBox* box : desktop_->window().findChildren<QCheckBox*>()) {
    if (box->isVisible() && box->text() == "Pause at a leak") leaks = box;
  }
  QVERIFY(leaks && leaks->isChecked());
  QTest::mouseClick(leaks, Qt::LeftButton, {}, QPoint(8, leaks->height() / 2));
  QVERIFY(!leaks->isChecked() && !desktop_->proxy().leak_rule());
  desktop_->press(Qt::Key_P);
  wait_for_rest();
  QVERIFY(!state().leak);
  QVERIFY(state().surface.volume_ml > 1.9 * kBallMl);
}

TIDEMARK_TEST(LeakStoryTest)

}  // namespace tidemark::test::leak_story_test

#include "leak_story_test.moc"
