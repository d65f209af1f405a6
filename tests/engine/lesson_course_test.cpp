// A lesson on its way, where its case fails or is closed.
#include "engine/lesson_course.h"

#include <QTest>

#include "engine/case_proxy.h"
#include "tests/engine/ball_study.h"
#include "tests/support/ball_lesson.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::lesson_course_test {

namespace {

constexpr int kPatience = 60'000;  // ms

}  // namespace

class LessonCourseTest : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    proxy_ = std::make_unique<engine::CaseProxy>(engine_, ball_study(), solver::ExecutorKind::host);
    auto lesson = document::Lesson::parse(kBallLesson, "ball.json");
    QCOMPARE(failure(lesson), QString());
    const glm::dvec3 middle = renderer::middle_of(proxy_->volume().geometry);
    lesson->start.emplace().seeds.push_back({middle, 10.0});
    course_ = std::make_unique<engine::LessonCourse>(*lesson, std::filesystem::path());
    course_->open_study();
    course_->take_case(*proxy_);
    course_->choose(0);
    course_->attempt();
    QVERIFY(course_->attempting());
  }
  void cleanup() {
    course_.reset();
    proxy_.reset();
  }

  void a_try_that_fails_leaves_its_case_at_rest_and_without_its_pace() {
    QTRY_VERIFY_WITH_TIMEOUT(proxy_->state().playing && proxy_->state().step > 0, kPatience);
    QVERIFY(proxy_->state().pace > 0.0);
    emit proxy_->failed(QStringLiteral("no memory"));
    QVERIFY(!course_->attempting());
    QTRY_VERIFY_WITH_TIMEOUT(!proxy_->state().playing, kPatience);
    QTRY_COMPARE(proxy_->state().pace, 0.0);
    QVERIFY(proxy_->state().step < course_->part().attempt->steps);
    QVERIFY(!course_->tried(0));
    QVERIFY(course_->can_attempt());
  }

  void a_case_that_is_closed_while_it_is_measured_leaves_nothing_to_wait_for() {
    QTRY_VERIFY_WITH_TIMEOUT(course_->tried(0) && course_->can_measure(), kPatience);
    course_->measure();
    QVERIFY(course_->measuring());
    proxy_.reset();
    QTRY_VERIFY(!course_->measuring());
    QVERIFY(course_->can_attempt());
    QVERIFY(course_->given().figures.empty());
  }

 private:
  engine::Engine engine_{false};
  std::unique_ptr<engine::CaseProxy> proxy_;
  std::unique_ptr<engine::LessonCourse> course_;
};

TIDEMARK_TEST(LessonCourseTest)

}  // namespace tidemark::test::lesson_course_test

#include "lesson_course_test.moc"
