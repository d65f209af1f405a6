// Languages: the same cases in another one at once, and whether each has all texts and they fit.
#include <QDialog>
#include <QLabel>
#include <QMenuBar>
#include <QPointer>
#include <QRegularExpression>
#include <QScopeGuard>
#include <QSet>
#include <QTimer>
#include <QTranslator>
#include <semaphore>

#include "engine/background_job.h"
#include "engine/lesson_course.h"
#include "tests/support/ball_lesson.h"
#include "tests/support/test_program.h"
#include "tests/ui/lessons/teacher.h"
#include "tests/ui/main/desktop.h"
#include "tests/ui/main/window_checks.h"
#include "ui/lessons/lesson_editor.h"
#include "ui/look/language.h"
#include "ui/main/message_bar.h"
#include "ui/main/panel_docks.h"
#include "ui/main/teaching.h"
#include "ui/main/value_bar.h"
#include "ui/settings.h"
#include "ui/widgets/status_progress.h"

namespace tidemark::test::languages_story_test {
namespace {

constexpr int kPatience = 60'000;  // ms

// Qt asks it for what no other translator knows.
class Untranslated : public QTranslator {
 public:
  Untranslated() { QCoreApplication::installTranslator(this); }
  ~Untranslated() override { QCoreApplication::removeTranslator(this); }

  [[nodiscard]] bool isEmpty() const override { return false; }
  QString translate(const char* context, const char* text, const char* /*comment*/,
                    int /*n*/) const override {
    static const QRegularExpression kWord("[^\\W\\d_]{2}", QRegularExpression::UseUnicodePropertiesOption);
    const bool of_qt = context && context[0] == 'Q';
    if (!of_qt && QString::fromUtf8(text).remove(QRegularExpression("%\\d")).contains(kWord)) {
      texts_ << QStringLiteral("%1: %2").arg(QString::fromUtf8(context), QString::fromUtf8(text));
    }
    return {};
  }
  [[nodiscard]] QStringList texts() const { return {texts_.begin(), texts_.end()}; }

 private:
  mutable QSet<QString> texts_;
};

class DesktopIn : public Desktop {
 public:
  explicit DesktopIn(const QByteArray& language)
      : Desktop((qputenv("TIDEMARK_STORY_LANGUAGE", language), story_executor())) {}
  ~DesktopIn() { qunsetenv("TIDEMARK_STORY_LANGUAGE"); }

  // By clicks in the menus, in which each language has its own name.
  void speak(const QString& language) {
    ui::MainWindow* before = &window();
    QAction* wanted = nullptr;
    for (QAction* action : window().actions().languages->actions()) {
      if (action->text() == language) wanted = action;
    }
    QVERIFY(wanted);
    const QString view = window().menuBar()->actions().at(2)->text();
    choose(QString(view).remove('&'), wanted);
    QVERIFY(wait_for([&] { return &window() != before; }, kPatience));
    // To make a window takes longer than an event may.
    WatchedApplication::instance().forget_held();
  }
  QString menu(int index) { return window().menuBar()->actions().at(index)->text().remove('&'); }
};

}  // namespace

class LanguagesStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void views_keep_their_room_when_the_theme_changes_in_another_language() {
    DesktopIn desktop("en");
    QVERIFY(desktop.open_phantom("sphere"));
    desktop.begin(10.0);
    desktop.speak("Deutsch");
    const auto sizes = [&] {
      QList<QSize> all;
      for (const ui::PictureView* view : desktop.window().active_case()->views()) all << view->size();
      return all;
    };
    desktop.press(Qt::Key_4, Qt::ControlModifier);
    desktop.wait_until_idle();
    QTest::qWait(500);
    const QList<QSize> before = sizes();
    for (QAction* theme : desktop.window().actions().themes->actions()) {
      theme->trigger();
      QTest::qWait(500);
      const QList<QSize> after = sizes();
      QCOMPARE(after.size(), before.size());
      for (qsizetype i = 0; i < after.size(); ++i) {
        const QSize by = after[i] - before[i];
        QVERIFY2(std::abs(by.width()) < 40 && std::abs(by.height()) < 40,
                 qPrintable(QStringLiteral("%1 x %2, was %3 x %4")
                                .arg(after[i].width())
                                .arg(after[i].height())
                                .arg(before[i].width())
                                .arg(before[i].height())));
      }
    }
  }

  void another_language_shows_the_same_cases() {
    DesktopIn desktop("en");
    QVERIFY(desktop.open_phantom("sphere"));
    desktop.begin(10.0);
    QVERIFY(desktop.open_phantom("dumbbell"));
    desktop.begin(8.0);
    desktop.window().actions().link->trigger();
    desktop.window().actions().lock_step->trigger();
    const QList<ui::CaseWindow*> cases = desktop.window().cases();
    QCOMPARE(cases.size(), qsizetype{2});
    cases[0]->add_view(ui::ViewKind::coronal);
    desktop.window().bring_to_front(*cases[0]);
    QVERIFY(Desktop::wait_for([&] { return desktop.window().active_case() == cases[0]; }));
    engine::CaseProxy* const first = &cases[0]->proxy();
    engine::CaseProxy* const second = &cases[1]->proxy();
    for (ui::CaseWindow* window : cases) {
      window->proxy().set_pause_at_convergence(false);
      window->proxy().set_pace(50.0);
    }
    const qsizetype views = cases[0]->views().size();
    const auto camera = first->display().settings().camera;
    first->play();
    QVERIFY(Desktop::wait_for([&] { return first->state().step > 3; }, kPatience));
    const QString undo_text = second->state().undo_text;
    QVERIFY(!undo_text.isEmpty());

    desktop.speak("Deutsch");
    QCOMPARE(desktop.menu(0), QStringLiteral("Datei"));
    const QList<ui::CaseWindow*> now = desktop.window().cases();
    QCOMPARE(now.size(), qsizetype{2});
    QCOMPARE(&now[0]->proxy(), first);
    QCOMPARE(&now[1]->proxy(), second);
    QCOMPARE(desktop.window().active_case(), now[0]);
    QCOMPARE(now[0]->number(), 1);
    QCOMPARE(now[1]->number(), 2);
    QVERIFY(now[0]->linked() && now[1]->linked());
    QVERIFY(desktop.window().actions().lock_step->isChecked());
    QVERIFY(first->in_lock_step() && second->in_lock_step());
    QVERIFY(Desktop::wait_for([&] { return second->state().undo_text != undo_text; }, kPatience));
    QCOMPARE(now[0]->views().size(), views);
    QCOMPARE(first->display().settings().camera.azimuth, camera.azimuth);
    QVERIFY(first->state().modified);
    first->display().set_pointer(first->volume().geometry.origin_mm);
    const QString values = desktop.window().findChild<ui::ValueBar*>()->text();
    QVERIFY2(values.contains(QRegularExpression("\\d,\\d; -?\\d+,\\d; -?\\d+,\\d mm")), qPrintable(values));
    // It plays on, and stops where it is told to in the new window.
    const std::int64_t step = first->state().step;
    QVERIFY(Desktop::wait_for([&] { return first->state().step > step + 3; }, kPatience));
    desktop.press(Qt::Key_P);
    QVERIFY(Desktop::wait_for([&] { return !first->state().playing; }, kPatience));
    desktop.wait_until_idle();
    for (ui::PictureView* view : now[0]->views()) {
      if (view->isVisible()) QVERIFY2(shows_a_picture(*view), qPrintable(view->title()));
    }
    desktop.screenshot("language-switched");

    // The others follow one that moves, as before.
    now[0]->proxy().display().change([](engine::DisplaySettings& s) { s.camera.azimuth += 25.0; });
    QCOMPARE(second->display().settings().camera.azimuth, first->display().settings().camera.azimuth);

    desktop.speak("日本語");
    QVERIFY(desktop.menu(0) != "Datei" && desktop.menu(0) != "File");
    QCOMPARE(&desktop.proxy(), first);
    desktop.speak("English");
    QCOMPARE(desktop.menu(0), QStringLiteral("File"));
    QCOMPARE(ui::settings::language().get(), QStringLiteral("en"));
  }

  void measures_stay_in_another_language() {
    DesktopIn desktop("en");
    QVERIFY(desktop.open_phantom("sphere"));
    desktop.begin(10.0);
    desktop.window().panels().show("statistics");
    desktop.wait_until_idle();
    QTest::mouseClick(seen<QAbstractButton>(desktop.window(), "Measure"), Qt::LeftButton);
    const auto longest = [&] {
      const auto* figure = find_seen<QLabel>(desktop.window(), "Longest");
      return figure ? figure->text() : QString();
    };
    QVERIFY(Desktop::wait_for([&] { return !longest().isEmpty(); }));
    const QString before = longest();
    desktop.speak("Deutsch");
    QVERIFY(longest().isEmpty());
    desktop.speak("English");
    QVERIFY(Desktop::wait_for([&] { return longest() == before; }));  // the panel is in front, as before
  }

  void work_that_is_on_its_way_is_not_given_up() {
    DesktopIn desktop("en");
    QVERIFY(desktop.open_phantom("sphere"));
    auto* progress = desktop.window().findChild<ui::StatusProgress*>();
    QVERIFY(progress);
    progress->show();
    QAction* german = desktop.window().actions().languages->actions().at(2);
    QCOMPARE(german->text(), QStringLiteral("Deutsch"));
    ui::MainWindow* const before = &desktop.window();
    german->trigger();
    QTest::qWait(200);
    QCOMPARE(&desktop.window(), before);
    QCOMPARE(ui::settings::language().get(), QStringLiteral("en"));
    QVERIFY(!german->isChecked());
    QVERIFY(desktop.window().findChild<ui::MessageBar*>()->text().contains("language"));
  }

  // While a language waits for work to end, such as a sweep.
  void a_dialog_that_is_opened_meanwhile_stays() {
    DesktopIn desktop("en");
    const auto end = std::make_shared<std::counting_semaphore<>>(0);
    const auto ended = qScopeGuard([end] { end->release(); });
    engine::BackgroundJob::start(&desktop.window(), [end](engine::BackgroundJob&) { end->acquire(); });
    ui::MainWindow* const before = &desktop.window();
    QAction* german = desktop.window().actions().languages->actions().at(2);
    german->trigger();
    desktop.choose("Teach", desktop.menu_entry("Teach", "Write a lesson"));
    const QPointer editor(before->findChild<ui::LessonEditor*>());
    QVERIFY(editor && Desktop::wait_for([&] { return editor->isVisible(); }));
    type<QLineEdit>(*editor, "Title", "How large a seed must be");
    end->release();
    QTest::qWait(300);
    QVERIFY(editor && editor->isVisible());
    QCOMPARE(at_hand<QLineEdit>(*editor, "Title")->text(), QStringLiteral("How large a seed must be"));
    QCOMPARE(&desktop.window(), before);
    QCOMPARE(ui::settings::language().get(), QStringLiteral("en"));
    QVERIFY(!german->isChecked());
    QVERIFY(desktop.window().findChild<ui::MessageBar*>()->text().contains("language"));
  }

  void a_lesson_goes_on_in_another_language() {
    DesktopIn desktop("en");
    const auto lesson = document::Lesson::parse(kBallLesson, "lesson");
    QVERIFY(lesson.has_value());
    desktop.window().teaching().begin(*lesson, {});
    engine::LessonCourse* const course = desktop.window().teaching().course();
    course->choose(1);
    course->attempt();
    QVERIFY(Desktop::wait_for([&] { return course->tried(0); }, kPatience));
    desktop.wait_until_idle();
    desktop.speak("Français");
    QCOMPARE(desktop.window().teaching().course(), course);
    QVERIFY(course->tried(0));
    QCOMPARE(course->proxy(), &desktop.proxy());
    course->measure();
    QVERIFY(Desktop::wait_for([&] { return course->done(0); }, kPatience));
    desktop.screenshot("language-lesson");
  }

  void every_language_has_all_texts_and_they_fit_data() {
    QTest::addColumn<QByteArray>("language");
    QTest::addColumn<bool>("mirrored");
    for (const ui::Language& language : ui::languages())
      QTest::newRow(language.code) << QByteArray(language.code) << false;
    QTest::newRow("from right to left") << QByteArray("en") << true;
  }

  void every_language_has_all_texts_and_they_fit() {
    QFETCH(QByteArray, language);
    QFETCH(bool, mirrored);
    const auto mirrored_back = qScopeGuard([] { QApplication::setLayoutDirection(Qt::LeftToRight); });
    if (mirrored) QApplication::setLayoutDirection(Qt::RightToLeft);
    const Untranslated untranslated;
    DesktopIn desktop(language);
    const QString name = QString::fromLatin1(language) + (mirrored ? "-mirrored" : "");
    desktop.screenshot_at_once("language-" + name + "-start");
    QVERIFY(desktop.open_phantom("dumbbell"));
    desktop.begin(8.0);
    desktop.window().active_case()->set_layout(ui::ViewLayout::two_two);
    desktop.proxy().step(100);
    desktop.proxy().accept_surface(0, document::Take::free_voxels, "A");
    desktop.wait_until_idle();
    desktop.window().panels().show("level-set");
    desktop.screenshot("language-" + name + "-steered");
    // Left and right in pictures are the patient's, in whatever direction people write.
    for (ui::PictureView* view : desktop.window().active_case()->views()) {
      const QImage picture = view->grab_picture();
      const QImage on_screen = view->grab().toImage();
      QApplication::setLayoutDirection(Qt::LeftToRight);
      QVERIFY2(view->grab_picture() == picture, qPrintable(view->title()));
      QVERIFY2(view->grab().toImage() == on_screen, qPrintable(view->title()));
      if (mirrored) QApplication::setLayoutDirection(Qt::RightToLeft);
    }
    QCOMPARE(doubled_menu_letters(desktop.window()).join("; "), QString());
    QCOMPARE(cut_bars(desktop.window()).join("; "), QString());
    QCOMPARE(panels_too_wide(desktop, name).join("; "), QString());
    see_dialog(desktop, *desktop.window().actions().export_segmentation, "language-" + name + "-export");
    see_dialog(desktop, *desktop.window().actions().send_result, "language-" + name + "-send");
    see_dialog(desktop, *desktop.window().actions().first_steps, "language-" + name + "-first-steps");
    see_dialog(desktop, *desktop.window().actions().about, "language-" + name + "-about");
    if (language != "en") QCOMPARE(untranslated.texts().join("; "), QString());
    // A mirrored word order is no fault; a window that is too wide for the screen is.
    QCOMPARE(desktop.window().width(), 1280);
    QCOMPARE(desktop.window().height(), 800);
  }

 private:
  static QDialog* open_dialog() {
    for (QWidget* widget : QApplication::topLevelWidgets()) {
      auto* dialog = qobject_cast<QDialog*>(widget);
      if (dialog && dialog->isVisible()) return dialog;
    }
    return nullptr;
  }
  // Opens it, and closes it again.
  static void see_dialog(Desktop& desktop, QAction& action, const QString& picture) {
    bool seen = false;
    QStringList doubles;
    std::function<void()> look = [&] {
      QDialog* dialog = open_dialog();
      if (!dialog) return QTimer::singleShot(50, &desktop.window(), look);
      doubles = doubled_letters(*dialog);
      const QString folder = qEnvironmentVariable("TIDEMARK_SCREENSHOTS");
      if (!folder.isEmpty()) dialog->grab().save(folder + '/' + picture + ".png");
      seen = true;
      dialog->close();
    };
    QTimer::singleShot(0, &desktop.window(), look);
    action.trigger();
    QVERIFY2(Desktop::wait_for([&] { return seen; }), qPrintable(action.text()));
    QCOMPARE(doubles.join("; "), QString());
    WatchedApplication::instance().forget_held();  // a picture takes longer than an event may
  }
};

TIDEMARK_TEST(LanguagesStoryTest)

}  // namespace tidemark::test::languages_story_test

#include "languages_story_test.moc"
