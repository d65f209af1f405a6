// The editor of lessons, driven by mouse and keys as a teacher would.
#include "ui/lessons/lesson_editor.h"

#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QListWidget>
#include <QMessageBox>
#include <QRadioButton>
#include <QScrollArea>
#include <QSignalSpy>
#include <QTableWidget>
#include <QToolButton>

#include "core/atomic_file.h"
#include "core/text_file.h"
#include "tests/support/test_program.h"
#include "tests/ui/lessons/teacher.h"
#include "tests/ui/panels/panel_case.h"
#include "ui/look/theme.h"

namespace tidemark::test::lesson_editor_test {

using document::Lesson;

namespace {

constexpr int kPatience = 60'000;

bool says(QWidget& editor, const QString& text) {
  for (const QLabel* label : editor.findChildren<QLabel*>()) {
    if (label->isVisible() && label->text().contains(text)) return true;
  }
  return false;
}

// Presses that button of the next question.
void answer(QMessageBox::StandardButton button) {
  auto* timer = new QTimer(qApp);
  QObject::connect(timer, &QTimer::timeout, timer, [timer, button] {
    auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
    if (box == nullptr) return;
    timer->deleteLater();
    QTest::mouseClick(box->button(button), Qt::LeftButton);
  });
  timer->start(20);
}

void screenshot(QWidget& window, const QString& name) {
  const QString pictures = qEnvironmentVariable("TIDEMARK_SCREENSHOTS");
  if (pictures.isEmpty()) return;
  for (const auto& [theme, ending] :
       {std::pair(ui::Theme::dark, "dark"), std::pair(ui::Theme::light, "light")}) {
    ui::apply_theme(*qApp, theme);
    QTest::qWait(300);  // until the problem has its colour
    QVERIFY(
        window.grab().save(QStringLiteral("%1/lesson-%2-%3.png").arg(pictures, name, QLatin1String(ending))));
  }
}

std::string text_of(const Lesson& lesson) {
  return lesson.to_text().value_or(std::string());
}

// A lesson with every field that a file can have.
constexpr const char* kFull = R"({
  "format": "tidemark lesson", "version": 1, "title": "All fields", "about": "Each is here.",
  "author": "A teacher", "minutes": 12, "study": {"phantom": "sphere:7.5"},
  "start": {"from": {"kind": "spheres"}, "seeds": [{"centre_mm": [1.25, 2.5, 3.125], "radius_mm": 4.0625}], "erasers": []},
  "parameters": {"target": 812.123456, "range": 300, "alpha": 0.1234567, "band": 3.5, "scheme": "paper"},
  "parts": [
    {"title": "First", "text": "One.\n\nTwo.",
     "question": {"text": "What?", "choices": ["a", "b", "c"], "right": 2},
     "try": {"parameters": {"alpha": 0.7, "data_term": false, "rescale": 0.33333},
             "smoothed_mm": 1.2345, "steps": 3, "until_rest": true, "show": ["truth", "contours"]},
     "measure": [{"figure": "dice", "low": 0.123456, "high": 1},
                 {"figure": "volume_ml", "low": 0, "high": 1000000}],
     "explanation": "Because."},
    {"title": "Second", "text": "More.", "question": {"text": "In words?"},
     "try": {"goes_on": true, "steps": 2}},
    {"title": "Third", "text": "Elsewhere.", "study": {"phantom": "bridge"}, "try": {"steps": 1}},
    {"title": "Fourth", "text": "To read."}
  ]
})";

}  // namespace

class LessonEditorTest : public QObject {
  Q_OBJECT

  // An editor of a new lesson, with the parameters that suit its phantom.
  static std::unique_ptr<ui::LessonEditor> shown_editor(ui::LessonEditor::ActiveCase active_case = {}) {
    auto editor = std::make_unique<ui::LessonEditor>(std::move(active_case));
    show(*editor);
    if (!QTest::qWaitFor([&] { return editor->lesson().parameters.target > 0.0; }, kPatience))
      qFatal("the phantom has no parameters");
    return editor;
  }

  static Lesson full_lesson() {
    auto lesson = Lesson::parse(kFull, "full.json");
    if (!lesson) qFatal("%s", lesson.error().message.c_str());
    return *lesson;
  }

 private slots:
  void cleanup() { ui::apply_theme(*qApp, ui::Theme::light); }

  void a_lesson_made_from_nothing_is_saved_as_it_was_typed() {
    const TemporaryFolder folder;
    const auto editor = shown_editor();
    type<QLineEdit>(*editor, "Title", "Shrinking");
    type<QPlainTextEdit>(*editor, "About", "A ball shrinks.");
    type<QLineEdit>(*editor, "Author", "Ada");
    type<ui::NumberBox>(*editor, "Time needed", "15");
    go_to(*editor, 1);
    QTRY_VERIFY(says(*editor, "Part 1, title: is empty"));
    type<QLineEdit>(*editor, "Title", "Alone");
    type<QPlainTextEdit>(*editor, "Text", "Look.");
    auto* question = editor->findChild<ui::QuestionForm*>();
    question->setFocus();
    QTest::keyClick(question, Qt::Key_Space);
    type<QPlainTextEdit>(*editor, "Question", "What happens?");
    click(*editor, "Add a choice");
    QTest::keyClicks(QApplication::focusWidget(), "It grows");
    click(*editor, "Add a choice");
    QTest::keyClicks(QApplication::focusWidget(), "It shrinks");
    click(*editor, "Choice 2 is right");
    type<ui::NumberBox>(*editor, "Steps", "12");
    click(*editor, "or until the surface rests");
    type<ui::NumberBox>(*editor, "Smoothing", "0.5");
    click(*editor, "Pages");
    click(*editor, "Add a figure");
    type<ui::NumberBox>(*editor, "From: Volume (ml)", "1,5");
    type<ui::NumberBox>(*editor, "To: Volume (ml)", "2.25");
    type<QPlainTextEdit>(*editor, "Explanation", "Curvature.");
    QTRY_VERIFY(says(*editor, "The lesson is complete."));
    screenshot(*editor, "part");

    const QSignalSpy saved(editor.get(), &ui::LessonEditor::saved);
    click(*editor, "&Save");
    QVERIFY(name_file(*editor, folder / "mine"));
    QTRY_COMPARE_WITH_TIMEOUT(saved.count(), 1, kPatience);
    QCOMPARE(saved[0][0].toString(), QString::fromStdString((folder / "mine.json").string()));
    QVERIFY(!editor->is_modified());
    const auto read = Lesson::load(folder / "mine.json");
    QCOMPARE(failure(read), QString());
    QCOMPARE(read->title, std::string("Shrinking"));
    QCOMPARE(read->about, std::string("A ball shrinks."));
    QCOMPARE(read->author, std::string("Ada"));
    QCOMPARE(read->minutes, 15);
    QCOMPARE(read->study.phantom, std::string("sphere"));
    QCOMPARE(read->parts.size(), std::size_t{1});
    const document::LessonPart& part = read->parts[0];
    QCOMPARE(part.title, std::string("Alone"));
    QCOMPARE(part.text, std::string("Look."));
    QCOMPARE(part.explanation, std::string("Curvature."));
    QVERIFY((part.question == document::LessonQuestion{"What happens?", {"It grows", "It shrinks"}, 1}));
    QVERIFY(part.attempt && !part.attempt->goes_on && part.attempt->until_rest);
    QCOMPARE(part.attempt->steps, std::int64_t{12});
    QCOMPARE(part.attempt->smoothed_mm, 0.5);
    QVERIFY(part.attempt->show == std::vector{document::LessonView::pages});
    QVERIFY(part.measures == (std::vector<document::LessonMeasure>{{"volume_ml", 1.5, 2.25}}));
  }

  void what_is_not_touched_stays_as_it_was() {
    const TemporaryFolder folder;
    const auto file = folder / "full.json";
    QCOMPARE(failure(write_file(file, kFull)), QString());
    const auto editor = shown_editor();
    editor->open(file);
    QTRY_COMPARE_WITH_TIMEOUT(editor->lesson().title, std::string("All fields"), kPatience);
    screenshot(*editor, "head");
    for (int row = 1; row <= 4; ++row) go_to(*editor, row);  // showing changes nothing
    QVERIFY(!editor->is_modified());
    go_to(*editor, 1);
    screenshot(*editor, "full-part");
    type<QLineEdit>(*editor, "Title", "Erste");
    go_to(*editor, 0);
    QTest::keyClick(editor.get(), Qt::Key_S, Qt::ControlModifier);
    QTRY_VERIFY_WITH_TIMEOUT(!editor->is_modified(), kPatience);
    Lesson expected = full_lesson();
    expected.parts[0].title = "Erste";
    const auto written = read_text_file(file, Lesson::kLargestFile);
    QCOMPARE(failure(written), QString());
    QCOMPARE(*written, text_of(expected));
  }

  void every_field_can_be_changed_and_no_other_changes_with_it() {
    const auto editor = shown_editor();
    Lesson expected = full_lesson();
    editor->edit(expected);
    const auto is_as_expected = [&] { return text_of(editor->lesson()) == text_of(expected); };
    type<ui::NumberBox>(*editor, "Data weight α", "0.7");  // as the first part has of its own
    expected.parameters.alpha = 0.7;
    for (std::size_t i = 1; i < 3; ++i) expected.parts[i].attempt->parameters.alpha = 0.7;
    type<ui::NumberBox>(*editor, "Data weight α", "0.25");
    expected.parameters.alpha = 0.25;
    for (std::size_t i = 1; i < 3; ++i) expected.parts[i].attempt->parameters.alpha = 0.25;
    QCOMPARE(text_of(editor->lesson()), text_of(expected));
    click(*editor, "Remove the lesson's own start");
    expected.start.reset();
    QCOMPARE(text_of(editor->lesson()), text_of(expected));
    type<ui::NumberBox>(*editor, "Noise in percent", "3");
    expected.study.phantom = "sphere:3";
    QCOMPARE(text_of(editor->lesson()), text_of(expected));

    go_to(*editor, 1);
    click(*editor, "Take back: Rescaling w");
    expected.parts[0].attempt->parameters.rescale = expected.parameters.rescale;
    choose(*editor, "Data term", "on");
    expected.parts[0].attempt->parameters.data_term = true;
    click(*editor, "Truth");
    std::erase(expected.parts[0].attempt->show, document::LessonView::truth);
    click(*editor, "None is wrong");
    expected.parts[0].question->right.reset();
    click(*editor, "Remove choice 1");
    expected.parts[0].question->choices.erase(expected.parts[0].question->choices.begin());
    click(*editor, "Remove: Dice");
    expected.parts[0].measures.erase(expected.parts[0].measures.begin());
    choose(*editor, "Figure 1", "Area (cm²)");
    expected.parts[0].measures[0].figure = "area_cm2";
    QCOMPARE(text_of(editor->lesson()), text_of(expected));

    go_to(*editor, 2);
    click(*editor, "from the start");
    expected.parts[1].attempt->goes_on = false;
    QCOMPARE(text_of(editor->lesson()), text_of(expected));
    go_to(*editor, 3);
    click(*editor, "Another study than the lesson's");
    expected.parts[2].study.reset();
    QVERIFY(is_as_expected());
    auto* attempt = editor->findChild<ui::TryForm*>();
    attempt->setFocus();
    QTest::keyClick(attempt, Qt::Key_Space);
    expected.parts[2].attempt.reset();
    QCOMPARE(text_of(editor->lesson()), text_of(expected));
  }

  void parts_are_added_moved_duplicated_and_removed() {
    const auto editor = shown_editor();
    editor->edit(full_lesson());
    const auto titles = [&] {
      QStringList all;
      for (const auto& part : editor->lesson().parts) all << QString::fromStdString(part.title);
      return all.join(u' ');
    };
    go_to(*editor, 3);
    QTest::keyClick(editor.get(), Qt::Key_Up, Qt::AltModifier);
    QTRY_COMPARE(titles(), QString("First Third Second Fourth"));
    QTest::keyClick(editor.get(), Qt::Key_Down, Qt::AltModifier);
    QTRY_COMPARE(titles(), QString("First Second Third Fourth"));
    QTest::keyClick(editor.get(), Qt::Key_Down, Qt::AltModifier);
    QTRY_COMPARE(titles(), QString("First Second Fourth Third"));
    click(*editor, "Duplicate the part");
    QCOMPARE(titles(), QString("First Second Fourth Third Third"));
    answer(QMessageBox::No);
    click(*editor, "Remove the part");
    QCOMPARE(titles(), QString("First Second Fourth Third Third"));
    answer(QMessageBox::Yes);
    click(*editor, "Remove the part");
    QCOMPARE(titles(), QString("First Second Fourth Third"));
    click(*editor, "Add a part");
    QVERIFY(qobject_cast<QLineEdit*>(editor->focusWidget()));
    QTest::keyClicks(editor->focusWidget(), "Last");
    QCOMPARE(titles(), QString("First Second Fourth Third Last"));
  }

  void a_problem_is_said_in_words_and_nothing_is_written() {
    const TemporaryFolder folder;
    const auto editor = shown_editor();
    editor->edit(full_lesson(), folder / "full.json");
    go_to(*editor, 1);
    type<ui::NumberBox>(*editor, "To: Dice", "0");
    QTRY_VERIFY(says(*editor, "Part 1 “First”, figure 1: the range ends below where it begins"));
    screenshot(*editor, "problem");
    click(*editor, "&Save");
    QTRY_VERIFY(says(*editor, "Not saved. Part 1 “First”"));
    QVERIFY(!std::filesystem::exists(folder / "full.json"));
    answer(QMessageBox::Discard);
    editor->edit(full_lesson());
    QTRY_VERIFY(says(*editor, "The lesson is complete."));
    go_to(*editor, 3);
    click(*editor, "Move the part up");
    QTRY_VERIFY(says(*editor, "Part 3 “Second”, try: goes on with another study"));
  }

  void a_hostile_file_is_refused_with_a_sentence() {
    const TemporaryFolder folder;
    const auto file = folder / "evil.json";
    std::string text = kFull;
    text.replace(text.find("\"sphere:7.5\""), 12, "\"../../secret\"");
    QCOMPARE(failure(write_file(file, text)), QString());
    const auto editor = shown_editor();
    const std::string before = text_of(editor->lesson());
    editor->open(file);
    QTRY_VERIFY_WITH_TIMEOUT(says(*editor, "study.phantom: unknown phantom '../../secret'"), kPatience);
    QCOMPARE(text_of(editor->lesson()), before);
    QVERIFY(!editor->is_modified());
  }

  void another_file_is_replaced_only_when_that_is_wanted() {
    const TemporaryFolder folder;
    QCOMPARE(failure(write_file(folder / "there.json", "precious")), QString());
    const auto editor = shown_editor();
    editor->edit(full_lesson());
    answer(QMessageBox::No);
    click(*editor, "Save &as…");
    QVERIFY(name_file(*editor, folder / "there"));
    QCOMPARE(*read_text_file(folder / "there.json", 100), std::string("precious"));
    const QSignalSpy saved(editor.get(), &ui::LessonEditor::saved);
    answer(QMessageBox::Yes);
    click(*editor, "Save &as…");
    QVERIFY(name_file(*editor, folder / "there.json"));
    QTRY_COMPARE_WITH_TIMEOUT(saved.count(), 1, kPatience);
    QCOMPARE(*read_text_file(folder / "there.json", Lesson::kLargestFile), text_of(full_lesson()));
  }

  void a_part_is_taken_from_the_case() {
    engine::Engine engine{false};
    engine::StudyLoader loader;
    QSignalSpy loaded(&loader, &engine::StudyLoader::loaded);
    loader.make_phantom("sphere");
    QTRY_COMPARE_WITH_TIMEOUT(loaded.count(), 1, kPatience);
    const auto study = loaded[0][0].value<std::shared_ptr<const engine::LoadedStudy>>();
    auto proxy = std::make_unique<engine::CaseProxy>(engine, study, solver::ExecutorKind::host);
    const auto idle = [&] { return QTest::qWaitFor([&] { return engine.idle(); }, kPatience); };
    solver::Parameters parameters = proxy->parameters();
    parameters.alpha = 0.3125;
    proxy->set_parameters(parameters);
    document::Start start;
    start.seeds.push_back({renderer::middle_of(study->volume->geometry), 5.5});
    proxy->begin(start);
    proxy->step(7);
    QVERIFY(idle());
    const auto editor = shown_editor([&] { return proxy.get(); });
    go_to(*editor, 1);
    click(*editor, "&Take from the case");
    QTRY_VERIFY_WITH_TIMEOUT(says(*editor, "Taken from the case."), kPatience);
    const auto& attempt = editor->lesson().parts[0].attempt;
    QCOMPARE(attempt->steps, std::int64_t{7});
    QVERIFY(attempt->parameters == parameters);
    QVERIFY(attempt->start && attempt->start->seeds == start.seeds);
    QVERIFY(says(*editor, "1 seed"));
    QCOMPARE(at_hand<ui::NumberBox>(*editor, "Data weight α")->value(), 0.3125);
    screenshot(*editor, "taken");

    // A place in another study makes no sense.
    click(*editor, "Another study than the lesson's");
    choose(*editor, "Phantom", "Leaking bridge");
    click(*editor, "Remove the part's own start");
    click(*editor, "&Take from the case");
    QTRY_VERIFY_WITH_TIMEOUT(says(*editor, "The case is of another study than the part"), kPatience);
    QVERIFY(!editor->lesson().parts[0].attempt->start);

    go_to(*editor, 0);
    click(*editor, "&Take from the case");
    QTRY_VERIFY_WITH_TIMEOUT(editor->lesson().start.has_value(), kPatience);
    QCOMPARE(editor->lesson().parameters.alpha, 0.3125);

    // A mask is of one grid, and no lesson file has one.
    document::Start painted;
    painted.from = document::MaskStart{std::make_shared<const BitMask>(proxy->state().phi->mask()), "mine"};
    proxy->begin(painted);
    QVERIFY(idle());
    click(*editor, "&Take from the case");
    QTRY_VERIFY_WITH_TIMEOUT(says(*editor, "The case begins with a mask"), kPatience);
    QVERIFY(editor->lesson().start->seeds == start.seeds);
    proxy.reset();
    click(*editor, "&Take from the case");
    QTRY_VERIFY(says(*editor, "No case is open."));
  }

  void figures_are_measured_and_the_whole_lesson_is_tried() {
    const auto editor = shown_editor();
    Lesson lesson = full_lesson();
    lesson.parts.resize(2);
    lesson.start.reset();
    lesson.parts[1].measures = {{"steps", 0, 0}, {"volume_ml", 0, 0}, {"bodies", 5, 5}};
    editor->edit(lesson);
    go_to(*editor, 2);
    type<ui::NumberBox>(*editor, "Tolerance", "10");
    click(*editor, "&Measure");
    QTRY_VERIFY_WITH_TIMEOUT(says(*editor, "Measured: the ranges are set"), kPatience);
    const auto outcomes = document::carry_out(lesson, {}, solver::ExecutorKind::host, {});
    QCOMPARE(failure(outcomes), QString());
    const auto& measures = editor->lesson().parts[1].measures;
    const double steps = *(*outcomes)[1].figures[0];
    const double volume = *(*outcomes)[1].figures[1];
    QCOMPARE(measures[0].low, std::round(steps * 0.9));
    QCOMPARE(measures[0].high, std::round(steps * 1.1));
    QVERIFY(measures[1].holds(volume * 0.9) && measures[1].holds(volume * 1.1));
    QVERIFY(!measures[1].holds(volume * 0.9 - 0.02) && !measures[1].holds(volume * 1.1 + 0.02));
    QVERIFY(measures[2] == (document::LessonMeasure{"bodies", 1, 1}));
    QCOMPARE(editor->lesson().parts[0].measures, lesson.parts[0].measures);
    screenshot(*editor, "measured");

    type<ui::NumberBox>(*editor, "From: Separate bodies", "3");
    type<ui::NumberBox>(*editor, "To: Separate bodies", "4");
    click(*editor, "Try a&ll");
    ui::LessonTrial* trial = nullptr;
    QTRY_VERIFY_WITH_TIMEOUT((trial = editor->findChild<ui::LessonTrial*>()) && trial->isVisible(),
                             kPatience);
    auto* table = trial->findChild<QTableWidget*>();
    QCOMPARE(table->rowCount(), 5);
    QStringList verdicts;
    for (int row = 0; row < 5; ++row) verdicts << table->item(row, 4)->text();
    QCOMPARE(verdicts.mid(2), QStringList({"yes", "yes", "no"}));
    screenshot(*trial, "trial");
  }

  void a_long_measurement_is_cancelled_and_changes_nothing() {
    const auto editor = shown_editor();
    Lesson lesson = full_lesson();
    lesson.parts.resize(1);
    lesson.study.phantom = "head";  // which is large
    lesson.start.reset();
    lesson.parts[0].attempt->parameters = {};
    lesson.parts[0].attempt->steps = Lesson::kMostSteps;
    lesson.parts[0].attempt->until_rest = false;
    editor->edit(lesson);
    go_to(*editor, 1);
    click(*editor, "&Measure");
    QTRY_VERIFY(!at_hand<QPushButton>(*editor, "&Measure")->isEnabled());
    screenshot(*editor, "measuring");
    click(*editor, "Cancel");
    QTRY_VERIFY_WITH_TIMEOUT(at_hand<QPushButton>(*editor, "&Measure")->isEnabled(), kPatience);
    QVERIFY(says(*editor, "Cancelled."));
    QCOMPARE(text_of(editor->lesson()), text_of(lesson));
    QVERIFY(!editor->is_modified());
  }

  void closing_asks_where_something_would_be_lost() {
    const TemporaryFolder folder;
    const auto editor = shown_editor();
    editor->edit(full_lesson(), folder / "full.json");
    type<QLineEdit>(*editor, "Title", "Changed");
    answer(QMessageBox::Cancel);
    click(*editor, "Close");
    QVERIFY(editor->isVisible() && editor->is_modified());
    answer(QMessageBox::Save);
    QTest::keyClick(editor.get(), Qt::Key_Escape);
    QTRY_VERIFY_WITH_TIMEOUT(!editor->isVisible(), kPatience);
    QCOMPARE(Lesson::load(folder / "full.json")->title, std::string("Changed"));
    show(*editor);
    auto* minutes = at_hand<ui::NumberBox>(*editor, "Time needed");
    minutes->setFocus();
    minutes->selectAll();
    QTest::keyClicks(minutes, "44");  // and is still in it
    QTest::keyClick(editor.get(), Qt::Key_S, Qt::ControlModifier);
    QTRY_COMPARE_WITH_TIMEOUT(Lesson::load(folder / "full.json")->minutes, 44, kPatience);
    QTRY_VERIFY(!editor->is_modified());
    type<QLineEdit>(*editor, "Title", "Lost");
    answer(QMessageBox::Discard);
    editor->close();
    QVERIFY(!editor->isVisible());
    QCOMPARE(Lesson::load(folder / "full.json")->title, std::string("Changed"));
  }

  void every_control_has_a_name_a_tip_and_a_way_by_keyboard() {
    const auto editor = shown_editor();
    editor->edit(full_lesson());
    for (const int row : {0, 1, 3}) {
      go_to(*editor, row);
      for (QWidget* control : editor->findChildren<QWidget*>()) {
        const auto* button = qobject_cast<QAbstractButton*>(control);
        const bool is_control = button || qobject_cast<QComboBox*>(control) ||
                                qobject_cast<ui::NumberBox*>(control) ||
                                qobject_cast<QPlainTextEdit*>(control);
        if (!is_control || !control->isVisible() || control->objectName().startsWith("qt_")) continue;
        const QString name = button ? button->text() + button->accessibleName() : control->accessibleName();
        const QString who = QLatin1String(control->metaObject()->className()) + ' ' + name;
        QVERIFY2(!name.isEmpty(), qPrintable(who));
        QVERIFY2(!control->toolTip().isEmpty(), qPrintable(who));
        QVERIFY2(control->focusPolicy() & Qt::TabFocus, qPrintable(who));
      }
    }
  }

  void the_window_fits_a_small_screen() {
    const auto editor = shown_editor();
    editor->edit(full_lesson());
    for (int row = 0; row <= 4; ++row) {
      go_to(*editor, row);
      QVERIFY(editor->width() <= 1366 && editor->height() <= 700);
      // Of a screen of that size at twice its scale.
      const QSize least = editor->minimumSizeHint();
      QVERIFY2(least.width() <= 683 && least.height() <= 384,
               qPrintable(QStringLiteral("%1 x %2").arg(least.width()).arg(least.height())));
    }
  }
};

TIDEMARK_TEST(LessonEditorTest)

}  // namespace tidemark::test::lesson_editor_test

#include "lesson_editor_test.moc"
