// A lesson of a teacher's own: written in the editor, opened from the menu, done and handed in; and large
// type.
#include <QDockWidget>
#include <QFile>
#include <QLabel>
#include <QMenu>
#include <QMenuBar>
#include <QSignalSpy>
#include <QTabBar>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "tests/support/test_program.h"
#include "tests/ui/file_dialog.h"
#include "tests/ui/lessons/teacher.h"
#include "tests/ui/main/results_desktop.h"
#include "tests/ui/main/student.h"
#include "ui/lessons/lesson_editor.h"
#include "ui/look/theme.h"

namespace tidemark::test::lesson_writing_story_test {

class LessonWritingStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void a_lesson_is_written_opened_and_done();
  void spheres_that_were_drawn_are_the_start();
  void the_start_page_leads_to_the_lessons();
  void large_type_reaches_every_text_and_outlives_the_theme();

 private:
  static ui::LessonEditor* editor_of(Desktop& desktop);
  static void write(ui::LessonEditor& editor, const std::filesystem::path& file);
};

ui::LessonEditor* LessonWritingStoryTest::editor_of(Desktop& desktop) {
  desktop.choose("Teach", desktop.menu_entry("Teach", "Write a lesson"));
  auto* editor = desktop.window().findChild<ui::LessonEditor*>();
  // The parameters that suit the first phantom come by themselves.
  const auto ready = [&] { return editor->isVisible() && editor->lesson().parameters.target > 0.0; };
  return editor && Desktop::wait_for(ready) ? editor : nullptr;
}

void LessonWritingStoryTest::write(ui::LessonEditor& editor, const std::filesystem::path& file) {
  type<QLineEdit>(editor, "Title", "How large a seed must be");
  type<QPlainTextEdit>(editor, "About", "Curvature and brightness pull in opposite directions.");
  type<ui::NumberBox>(editor, "Data weight α", "0.2");

  go_to(editor, 1);
  type<QLineEdit>(editor, "Title", "What to look at");
  type<QPlainTextEdit>(editor, "Text", "A bright ball of 20 mm in the dark.");
  // Without a try it is there to be read.
  auto* attempt = editor.findChild<ui::TryForm*>();
  attempt->setFocus();
  QTest::keyClick(attempt, Qt::Key_Space);

  click(editor, "Add a part");
  type<QLineEdit>(editor, "Title", "A small seed");
  type<QPlainTextEdit>(editor, "Text", "The seed is the phantom's own.");
  auto* question = editor.findChild<ui::QuestionForm*>();
  question->setFocus();
  QTest::keyClick(question, Qt::Key_Space);
  type<QPlainTextEdit>(editor, "Question", "What becomes of it?");
  for (const char* choice : {"It vanishes", "It grows to the ball's border"}) {
    click(editor, "Add a choice");
    QTest::keyClicks(QApplication::focusWidget(), choice);
  }
  click(editor, "Choice 1 is right");
  type<ui::NumberBox>(editor, "Steps", "60");
  click(editor, "Contours");
  click(editor, "Add a figure");
  click(editor, "&Measure");
  QVERIFY(
      Desktop::wait_for([&] { return editor.lesson().parts[1].measures[0].high > 0.0; }, kLessonPatience));
  type<QPlainTextEdit>(editor, "Explanation", "Curvature is the stronger one.");

  const QSignalSpy saved(&editor, &ui::LessonEditor::saved);
  click(editor, "&Save");
  QVERIFY(name_file(editor, file));
  QTRY_COMPARE(saved.count(), 1);
  click(editor, "Close");
  QVERIFY(!editor.isVisible());
}

void LessonWritingStoryTest::a_lesson_is_written_opened_and_done() {
  Desktop desktop(story_executor(), {1366, 768});
  const TemporaryFolder folder;
  ui::LessonEditor* editor = editor_of(desktop);
  QVERIFY(editor);
  write(*editor, folder / "mine.json");
  if (QTest::currentTestFailed()) return;

  Student student(desktop);
  name_file_when_asked(QString::fromStdString((folder / "mine.json").string()));
  desktop.choose("Teach", desktop.menu_entry("Teach", "Open lesson"));
  QVERIFY(Desktop::wait_for([&] { return student.panel() != nullptr; }));
  QVERIFY(student.reads("A bright ball of 20 mm in the dark."));
  student.go_on();
  student.choose(0);
  if (QTest::currentTestFailed()) return;
  student.try_out();
  if (QTest::currentTestFailed()) return;
  QCOMPARE(desktop.state().step, std::int64_t{60});
  student.measure();
  if (QTest::currentTestFailed()) return;
  QVERIFY(student.reads("as expected"));
  QVERIFY(student.reads("Your prediction was right."));
  QVERIFY(student.reads("Curvature is the stronger one."));
  student.sign("Ada");
  student.hand_in("Save as table…", folder / "answers.csv");
  QFile table(QString::fromStdString((folder / "answers.csv").string()));
  QVERIFY(table.open(QIODevice::ReadOnly));
  const QByteArray written = table.readAll();
  QVERIFY2(written.contains("\"What becomes of it?\",\"It vanishes\",\"It vanishes\",yes"),
           written.constData());
}

// As a teacher begins: a sphere drawn in a slice of the phantom, another one, and a part of it erased.
void LessonWritingStoryTest::spheres_that_were_drawn_are_the_start() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  const glm::dvec3 seed = desktop.seed_mm();
  const auto place = [&](double x) { return seed + glm::dvec3(x, 0.0, 0.0); };
  desktop.drag(*axial, {place(-10.0), place(-4.0)});
  desktop.wait_until_idle();
  desktop.drag(*axial, {place(10.0), place(15.0)});
  desktop.wait_until_idle();
  ui::LessonEditor* editor = editor_of(desktop);
  QVERIFY(editor);
  click(*editor, "&Take from the case");
  QVERIFY(Desktop::wait_for([&] { return editor->lesson().start.has_value(); }));
  const document::Start& start = *editor->lesson().start;
  QCOMPARE(start.seeds.size(), std::size_t{2});
  QVERIFY(glm::distance(start.seeds[0].centre_mm, place(-10.0)) < 1.0);
  QVERIFY(std::abs(start.seeds[1].radius_mm - 5.0) < 1.0);
  QVERIFY(start.erasers.empty());
  // What is erased is an eraser, and nothing is said of another end.
  desktop.drag(*axial, {place(-10.0), place(-8.0)}, Qt::RightButton);
  desktop.wait_until_idle();
  click(*editor, "&Take from the case");
  QVERIFY(Desktop::wait_for([&] { return editor->lesson().start->erasers.size() == 1; }));
  QVERIFY(!says(*editor, "The case was changed on its way"));
  // After that a sphere that is added has no place in a start.
  desktop.drag(*axial, {place(0.0), place(3.0)});
  desktop.wait_until_idle();
  click(*editor, "&Take from the case");
  QVERIFY(Desktop::wait_for([&] { return says(*editor, "The case was changed on its way"); }));
  QCOMPARE(editor->lesson().start->seeds.size(), std::size_t{2});
}

void LessonWritingStoryTest::the_start_page_leads_to_the_lessons() {
  Desktop desktop(story_executor(), {1366, 768});
  auto* card = desktop.window().findChild<QAbstractButton*>("lessons");
  QVERIFY(card);
  desktop.screenshot("start-page");
  Student::click(*card);
  QVERIFY(Desktop::wait_for([] { return QApplication::activePopupWidget() != nullptr; }));
  auto* list = qobject_cast<QMenu*>(QApplication::activePopupWidget());
  QVERIFY(list);
  QAction* lesson = desktop.menu_entry("Teach", "3 ");
  QTest::mouseClick(list, Qt::LeftButton, {}, list->actionGeometry(lesson).center());
  QVERIFY(desktop.window().teaching().course());
  QCOMPARE(desktop.window().teaching().course()->lesson().title,
           document::Lesson::parse(document::own_lessons()[2].text, "")->title);
}

// Each text of the panel and of the menu bar, as high as it was, times the factor.
void LessonWritingStoryTest::large_type_reaches_every_text_and_outlives_the_theme() {
  Desktop desktop(story_executor(), {1366, 768});
  Student student(desktop);
  student.open_own(2);
  const auto heights = [&] {
    std::map<QString, int> all{{"menus", desktop.window().menuBar()->fontMetrics().height()}};
    for (const QWidget* part : student.panel()->findChildren<QWidget*>()) {
      const auto* label = qobject_cast<const QLabel*>(part);
      const auto* button = qobject_cast<const QAbstractButton*>(part);
      const QString text = label ? label->text() : button ? button->text() : QString();
      if (!text.isEmpty()) all[text] = part->fontMetrics().height();
    }
    return all;
  };
  // The text that is not larger than it was; empty: each is.
  const auto left_behind = [&](const std::map<QString, int>& before) {
    for (const auto& [text, height] : heights()) {
      if (!before.contains(text) || height < 1.3 * before.at(text)) return text;
    }
    return QString();
  };
  // How far the title of the panel reaches, in pixels.
  const auto title_width = [&] {
    auto* dock = desktop.window().findChild<QDockWidget*>("lesson");
    const QImage title = dock->grab(QRect(0, 0, dock->width() / 2, dock->widget()->y())).toImage();
    int width = 0;
    for (int y = 2; y < title.height() - 2; ++y) {
      for (int x = 2; x < title.width(); ++x) {
        if (title.pixelColor(x, y) != title.pixelColor(2, 2)) width = std::max(width, x);
      }
    }
    return width;
  };
  const int usual_width = title_width();
  const std::map<QString, int> usual = heights();
  QAction* projector = desktop.menu_entry("Teach", "Projector");
  desktop.choose("Teach", projector);
  QVERIFY(projector->isChecked());
  QTRY_COMPARE(left_behind(usual), QString());
  QVERIFY2(title_width() > 1.3 * usual_width,
           qPrintable(QString("%1, before %2").arg(title_width()).arg(usual_width)));
  desktop.screenshot("projector-light");
  const auto choose_theme = [&](ui::Theme theme) {
    QAction* action = desktop.window().actions().themes->actions().at(static_cast<int>(theme));
    Desktop::in_an_event([action] { action->trigger(); });
  };
  choose_theme(ui::Theme::dark);
  QCOMPARE(left_behind(usual), QString());
  desktop.screenshot("projector-dark");
  student.choose(0);
  student.try_out();
  if (QTest::currentTestFailed()) return;
  student.measure();
  desktop.screenshot("projector-dark-measured");
  // The names of the panels are whole.
  QStringList cut;
  int names = 0;
  for (auto* tabs : desktop.window().findChildren<QTabBar*>(QString(), Qt::FindDirectChildrenOnly)) {
    for (int tab = 0; tabs->isVisible() && tab < tabs->count(); ++tab, ++names) {
      const int room = std::max(tabs->tabRect(tab).width(), tabs->tabRect(tab).height());
      if (room < tabs->fontMetrics().horizontalAdvance(tabs->tabText(tab))) cut << tabs->tabText(tab);
    }
  }
  QVERIFY(names > 5);
  QCOMPARE(cut.join('|'), QString());
  choose_theme(ui::Theme::light);
  desktop.screenshot("projector-light-measured");
  desktop.choose("Teach", projector);
  QTRY_COMPARE(desktop.window().menuBar()->fontMetrics().height(), usual.at("menus"));
}

TIDEMARK_TEST(LessonWritingStoryTest)

}  // namespace tidemark::test::lesson_writing_story_test

#include "lesson_writing_story_test.moc"
