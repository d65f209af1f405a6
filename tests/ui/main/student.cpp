#include "tests/ui/main/student.h"

#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>
#include <QRadioButton>

#include "tests/ui/file_dialog.h"
#include "tests/ui/main/story_language.h"
#include "ui/lessons/hand_in_box.h"
#include "ui/widgets/into_sight.h"

namespace tidemark::test {

void Student::open_own(int number) {
  const QString menu = in_story_language("Te&ach").remove('&');
  QAction* lesson = desktop_.menu_entry(menu, QStringLiteral("%1 ").arg(number));
  QVERIFY(lesson);
  desktop_.choose(menu, lesson);
  QVERIFY(Desktop::wait_for([&] { return panel() && panel()->isVisible(); }));
}

ui::LessonPanel* Student::panel() const {
  return desktop_.window().findChild<ui::LessonPanel*>();
}

QPushButton* Student::button(const QString& text) const {
  for (auto* found : panel()->findChildren<QPushButton*>()) {
    if (found->text() == text && found->isVisibleTo(panel())) return found;
  }
  return nullptr;
}

void Student::click(QWidget& widget, QPoint at) {
  const bool in_sight = Desktop::wait_for([&] {
    ui::bring_into_sight(widget);
    return widget.visibleRegion().contains(at);
  });
  QVERIFY2(in_sight, widget.metaObject()->className());
  QTest::mouseClick(&widget, Qt::LeftButton, {}, at);
}

void Student::choose(std::size_t choice) {
  const auto buttons = panel()->findChildren<QRadioButton*>();
  QVERIFY(choice < static_cast<std::size_t>(buttons.size()));
  QRadioButton* wanted = buttons.at(static_cast<qsizetype>(choice));
  // On its text, as most do.
  for (QLabel* label : panel()->findChildren<QLabel*>()) {
    if (label->buddy() == wanted) click(*label, QPoint(4, label->fontMetrics().height() / 2));
  }
  QVERIFY(wanted->isChecked());
}

void Student::answer(const QString& words) {
  for (QLineEdit* line : panel()->findChildren<QLineEdit*>()) {
    if (line->accessibleName() != "Your answer") continue;
    click(*line);
    return QTest::keyClicks(line, words);
  }
  QFAIL("there is no place for an answer");
}

void Student::try_out() {
  const std::size_t part = course().index();
  QPushButton* set_up = button("Set up and play");
  QVERIFY(set_up && set_up->isEnabled());
  click(*set_up);
  QVERIFY(Desktop::wait_for([&] { return course().tried(part) && !course().attempting(); }, kLessonPatience));
}

void Student::measure() {
  QPushButton* wanted = button("Measure");
  QVERIFY(wanted);
  QVERIFY(Desktop::wait_for([&] { return wanted->isEnabled() && course().can_measure(); }, kLessonPatience));
  click(*wanted);
  const std::size_t part = course().index();
  QVERIFY(Desktop::wait_for([&] { return course().done(part); }, kLessonPatience));
  // The outcome comes into sight by itself.
  desktop_.wait_until_idle();
  QVERIFY(sees("as expected"));
  QVERIFY(sees("Why"));
}

void Student::go_on() {
  const std::size_t next = course().index() + 1;
  QVERIFY(button(in_story_language("Next")) && button(in_story_language("Next"))->isEnabled());
  click(*button(in_story_language("Next")));
  QCOMPARE(course().index(), next);
}

bool Student::reads(const QString& text) const {
  for (const QLabel* label : panel()->findChildren<QLabel*>()) {
    if (label->isVisibleTo(panel()) && label->text() == text) return true;
  }
  return false;
}

bool Student::sees(const QString& text) const {
  for (const QLabel* label : panel()->findChildren<QLabel*>()) {
    if (label->text() == text && label->visibleRegion() == label->rect()) return true;
  }
  return false;
}

void Student::sign(const QString& name) {
  auto* box = panel()->findChild<ui::HandInBox*>();
  QVERIFY(box);
  auto* line = box->findChild<QLineEdit*>();
  click(*line);
  QTest::keyClicks(line, name);
}

void Student::hand_in(const QString& save, const std::filesystem::path& file) {
  QVERIFY(button(save));
  QVERIFY(Desktop::wait_for([&] { return button(save)->isEnabled(); }));
  name_file_when_asked(QString::fromStdString(file.string()));
  click(*button(save));
  const QString wrote = QStringLiteral("Wrote ") + QString::fromStdString(file.string());
  QVERIFY(Desktop::wait_for([&] { return sees(wrote); }, kLessonPatience));
}

void Student::end() {
  if (course().has_news()) Desktop::answer(QMessageBox::Yes);
  click(*button("End lesson"));
  QVERIFY(Desktop::wait_for([&] { return !desktop_.window().teaching().course(); }));
}

}  // namespace tidemark::test
