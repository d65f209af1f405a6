// A lesson as a student does it: predict, try, measure, read why, and hand in.
#include <QFile>
#include <QLineEdit>
#include <QMessageBox>
#include <QPushButton>
#include <QRadioButton>

#include "document/lesson.h"
#include "engine/lesson_course.h"
#include "tests/support/ball_lesson.h"
#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "ui/lessons/hand_in_box.h"
#include "ui/lessons/lesson_panel.h"
#include "ui/main/teaching.h"

namespace tidemark::test::lesson_story_test {
namespace {

constexpr int kPatience = 120'000;  // ms

QPushButton* button(QWidget& in, const QString& text) {
  for (auto* found : in.findChildren<QPushButton*>()) {
    if (found->text() == text && found->isVisible()) return found;
  }
  return nullptr;
}

}  // namespace

class LessonStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void the_study_opens_with_its_part();
  void a_lesson_without_answers_ends_without_a_question();
  void another_lesson_takes_no_answers_without_a_question();
  void a_lesson_is_done_from_its_first_part_to_its_file();
};

void LessonStoryTest::a_lesson_is_done_from_its_first_part_to_its_file() {
  Desktop desktop(story_executor(), {1366, 768});
  const auto lesson = document::Lesson::parse(kBallLesson, "lesson");
  QVERIFY(lesson.has_value());
  desktop.window().teaching().begin(*lesson, {});
  const engine::LessonCourse& course = *desktop.window().teaching().course();
  auto* panel = desktop.window().findChild<ui::LessonPanel*>();
  QVERIFY(panel);
  QVERIFY(Desktop::wait_for([&] { return button(*panel, "Set up and play") != nullptr; }, kPatience));

  // A prediction comes before the try.
  QVERIFY(!button(*panel, "Set up and play")->isEnabled());
  const auto choices = panel->findChildren<QRadioButton*>();
  QCOMPARE(choices.size(), qsizetype(2));
  choices.at(1)->click();
  QTest::mouseClick(button(*panel, "Set up and play"), Qt::LeftButton);
  QVERIFY(Desktop::wait_for([&] { return course.tried(0); }, kPatience));
  QCOMPARE(desktop.state().step, std::int64_t{60});
  QVERIFY(!choices.at(0)->isEnabled());
  QVERIFY(!course.done(0));

  QVERIFY(Desktop::wait_for([&] { return course.can_measure(); }, kPatience));
  QTest::mouseClick(button(*panel, "Measure"), Qt::LeftButton);
  QVERIFY(Desktop::wait_for([&] { return course.done(0); }, kPatience));
  QVERIFY(course.lesson().parts[0].measures[0].holds(*course.answers().parts[0].figures[0]));
  desktop.screenshot("lesson-measured");

  // The next try goes on from there, also after the student has done something else.
  desktop.proxy().step(7);
  for (int i = 0; i < 2; ++i) QTest::mouseClick(button(*panel, "Next"), Qt::LeftButton);
  QVERIFY(Desktop::wait_for([&] { return button(*panel, "Set up and play") != nullptr; }, kPatience));
  desktop.wait_until_idle();
  QTest::mouseClick(button(*panel, "Set up and play"), Qt::LeftButton);
  QVERIFY(Desktop::wait_for([&] { return course.tried(2) && !course.attempting(); }, kPatience));
  QCOMPARE(desktop.state().step, std::int64_t{100});
  QVERIFY(Desktop::wait_for([&] { return course.can_measure(); }, kPatience));
  QTest::mouseClick(button(*panel, "Measure"), Qt::LeftButton);
  QVERIFY(Desktop::wait_for([&] { return course.done(2); }, kPatience));

  // Another band begins the same case anew.
  QTest::mouseClick(button(*panel, "Next"), Qt::LeftButton);
  QVERIFY(Desktop::wait_for([&] { return button(*panel, "Set up and play") != nullptr; }, kPatience));
  QTest::mouseClick(button(*panel, "Set up and play"), Qt::LeftButton);
  QVERIFY(Desktop::wait_for([&] { return course.done(3); }, kPatience));
  QCOMPARE(desktop.state().step, std::int64_t{20});
  QCOMPARE(desktop.state().band, 5.0);

  // One case was opened, and the answers have the student's name.
  QCOMPARE(desktop.window().cases().size(), qsizetype(1));
  auto* hand_in = panel->findChild<ui::HandInBox*>();
  QVERIFY(hand_in);
  QTest::keyClicks(hand_in->findChild<QLineEdit*>(), "Ada");
  const TemporaryFolder folder;
  for (const char* name : {"answers.csv", "answers.PDF"}) {
    const QString file = QString::fromStdString((folder / name).string());
    hand_in->write(file);
    QVERIFY(Desktop::wait_for([&] { return QFile::exists(file); }, kPatience));
    QFile written(file);
    QVERIFY(written.open(QIODevice::ReadOnly));
    const QByteArray bytes = written.readAll();
    QVERIFY(file.endsWith(".csv") ? bytes.contains("Ada") : bytes.startsWith("%PDF"));
  }
}

void LessonStoryTest::the_study_opens_with_its_part() {
  Desktop desktop(story_executor(), {1366, 768});
  auto lesson = document::Lesson::parse(kBallLesson, "lesson");
  QVERIFY(lesson.has_value());
  lesson->parts[1].study = document::LessonStudy{"dumbbell", {}};
  ui::Teaching& teaching = desktop.window().teaching();
  teaching.begin(*lesson, {});
  const engine::LessonCourse& course = *teaching.course();
  const auto is_open = [&](qsizetype cases) {
    return Desktop::wait_for([&] { return desktop.window().cases().size() == cases && course.proxy(); },
                             kPatience);
  };
  QVERIFY(is_open(1));
  desktop.wait_until_idle();
  QVERIFY(!desktop.state().begun);  // it is to be looked at
  QVERIFY(!course.tried(0) && !course.has_news());
  desktop.screenshot("lesson-opened");
  auto* panel = desktop.window().findChild<ui::LessonPanel*>();
  QTest::mouseClick(button(*panel, "Next"), Qt::LeftButton);
  QVERIFY(is_open(2));
  QVERIFY(Desktop::wait_for([&] { return desktop.proxy().origin().phantom == "dumbbell"; }));
  QTest::mouseClick(button(*panel, "Back"), Qt::LeftButton);
  QTest::mouseClick(button(*panel, "Next"), Qt::LeftButton);
  desktop.wait_until_idle();
  QVERIFY(is_open(2));
  // One that was closed opens again when its part is shown again, and once only.
  desktop.window().active_case()->close_saved();
  QVERIFY(Desktop::wait_for([&] { return desktop.window().cases().size() == 1 && !course.proxy(); }));
  QTest::mouseClick(button(*panel, "Back"), Qt::LeftButton);
  QTest::mouseClick(button(*panel, "Next"), Qt::LeftButton);
  QVERIFY(is_open(2));
}

void LessonStoryTest::a_lesson_without_answers_ends_without_a_question() {
  Desktop desktop(story_executor(), {1366, 768});
  const auto lesson = document::Lesson::parse(kBallLesson, "lesson");
  QVERIFY(lesson.has_value());
  ui::Teaching& teaching = desktop.window().teaching();
  const auto panel = [&] { return desktop.window().findChild<ui::LessonPanel*>(); };
  teaching.begin(*lesson, {});
  QVERIFY(Desktop::wait_for([&] { return teaching.course()->proxy() != nullptr; }, kPatience));
  QTest::mouseClick(button(*panel(), "End lesson"), Qt::LeftButton);
  QVERIFY(Desktop::wait_for([&] { return teaching.course() == nullptr; }));
  QCOMPARE(desktop.window().cases().size(), qsizetype(1));

  teaching.begin(*lesson, {});
  QVERIFY(Desktop::wait_for([&] { return teaching.course()->proxy() != nullptr; }, kPatience));
  panel()->findChildren<QRadioButton*>().at(0)->click();
  Desktop::answer(QMessageBox::No);
  QTest::mouseClick(button(*panel(), "End lesson"), Qt::LeftButton);
  desktop.wait_until_idle();
  QVERIFY(teaching.course());
}

void LessonStoryTest::another_lesson_takes_no_answers_without_a_question() {
  Desktop desktop(story_executor(), {1366, 768});
  const auto lesson = document::Lesson::parse(kBallLesson, "lesson");
  QVERIFY(lesson.has_value());
  ui::Teaching& teaching = desktop.window().teaching();
  const auto title = [&] { return teaching.course()->lesson().title; };
  teaching.begin(*lesson, {});
  QVERIFY(Desktop::wait_for([&] { return teaching.course()->proxy() != nullptr; }, kPatience));
  desktop.window().findChild<ui::LessonPanel*>()->findChildren<QRadioButton*>().at(0)->click();
  QVERIFY(teaching.course()->has_news());

  QAction* own = desktop.menu_entry("Teach", "1 ");
  QVERIFY(own);
  Desktop::answer(QMessageBox::No);
  desktop.choose("Teach", own);
  QCOMPARE(title(), lesson->title);
  QVERIFY(teaching.course()->has_news());

  // Nor does one that a crash has left.
  document::RescuedLesson rescued;
  rescued.lesson = *lesson;
  rescued.lesson.title = "Left behind";
  rescued.progress = teaching.course()->progress();
  Desktop::answer(QMessageBox::No);
  teaching.go_on(rescued);
  QCOMPARE(title(), lesson->title);

  Desktop::answer(QMessageBox::Yes);
  desktop.choose("Teach", own);
  QVERIFY(Desktop::wait_for([&] { return title() != lesson->title; }));
  QVERIFY(!teaching.course()->has_news());
  desktop.wait_until_idle();
}

TIDEMARK_TEST(LessonStoryTest)

}  // namespace tidemark::test::lesson_story_test

#include "lesson_story_test.moc"
