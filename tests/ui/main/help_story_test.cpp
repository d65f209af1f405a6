// F1 opens the handbook's page of what has the keyboard. With TIDEMARK_SCREENSHOTS it leaves the pictures of
// the panels that the pages show.
#include <QDesktopServices>
#include <QDir>
#include <QDockWidget>
#include <QFileInfo>
#include <QKeySequenceEdit>
#include <QTableWidget>
#include <QTimer>

#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "tests/ui/main/story_language.h"
#include "tests/ui/main/student.h"
#include "ui/main/help.h"
#include "ui/main/keys_dialog.h"
#include "ui/main/message_bar.h"
#include "ui/main/panel_docks.h"

namespace tidemark::test::help_story_test {

namespace {

// An empty page for each page of the handbook's source.
class Handbook {
 public:
  Handbook() {
    const QDir source(QStringLiteral(TIDEMARK_SOURCE "/handbook"));
    for (const QString& below : {QString("."), QString("panels")}) {
      for (const QString& page : QDir(source.filePath(below)).entryList({"*.md"}))
        add(QStringLiteral("%1/%2.html").arg(below, page.chopped(3)));
    }
  }
  void add(const QString& page) {
    const QString path = folder() + "/" + page;
    QDir().mkpath(QFileInfo(path).path());
    QFile file(path);
    if (!file.open(QIODevice::WriteOnly)) qFatal("a page cannot be made");
  }
  [[nodiscard]] QString folder() const { return QString::fromStdString(folder_.path().string()); }

 private:
  TemporaryFolder folder_;
};

QWidget* first_that_takes_keys(QWidget& in) {
  for (QWidget* widget : in.findChildren<QWidget*>()) {
    if (widget->isVisible() && widget->isEnabled() && (widget->focusPolicy() & Qt::TabFocus)) return widget;
  }
  return nullptr;
}

}  // namespace

// In place of the system's browser: it keeps what it is asked for.
class Browser : public QObject {
  Q_OBJECT
 public:
  Browser() { QDesktopServices::setUrlHandler("file", this, "open"); }
  ~Browser() override { QDesktopServices::unsetUrlHandler("file"); }

  // The page that was asked for last, from the folder on; "" when there was none.
  QString page(const Handbook& handbook) {
    const QString file = QDir(QFileInfo(handbook.folder()).canonicalFilePath()).relativeFilePath(path_);
    const QString page = path_.isEmpty() ? path_ : file;
    path_.clear();
    return page;
  }

 public slots:  // NOLINT
  void open(const QUrl& url) { path_ = url.toLocalFile(); }

 private:
  QString path_;
};

class HelpStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void every_panel_has_its_page();
  void the_lesson_has_its_page();
  void dialogs_have_theirs();
  void without_a_panel_it_is_the_first_page();
  void pages_in_the_language_of_the_program_come_first();
  void without_a_handbook_a_message_says_where_it_is();
};

void HelpStoryTest::every_panel_has_its_page() {
  const Handbook handbook;
  Browser browser;
  Desktop desktop(story_executor(), {1382, 1000});
  desktop.window().help().look_in({"/nowhere", handbook.folder()});
  QVERIFY(desktop.open_phantom("tumour"));
  desktop.begin(14.0);
  desktop.proxy().play();
  QVERIFY(Desktop::wait_for([&] { return desktop.state().step > 30 && !desktop.state().playing; }, 120000));
  desktop.window().panels().show("labels");
  desktop.wait_until_idle();
  QTest::mouseClick(seen<QAbstractButton>(desktop.window(), in_story_language("Accept surface into label")),
                    Qt::LeftButton);
  desktop.wait_until_idle();

  QStringList pages;
  for (const QDockWidget* dock : desktop.window().findChildren<QDockWidget*>()) {
    if (dock->parentWidget() == &desktop.window()) pages << dock->objectName();
  }
  QVERIFY(pages.size() >= 10);
  for (const QString& name : pages) {
    desktop.window().panels().show(name);
    desktop.wait_until_idle();
    auto* dock = desktop.window().findChild<QDockWidget*>(name);
    QVERIFY2(Desktop::wait_for([&] { return first_that_takes_keys(*dock->widget()) != nullptr; }),
             qPrintable(name));
    desktop.window().activateWindow();
    first_that_takes_keys(*dock->widget())->setFocus();
    desktop.press(Qt::Key_F1);
    QCOMPARE(browser.page(handbook), QStringLiteral("panels/%1.html").arg(name));
    Desktop::keep_picture(*dock);
  }
}

void HelpStoryTest::the_lesson_has_its_page() {
  const Handbook handbook;
  Browser browser;
  Desktop desktop(story_executor(), {1382, 900});
  desktop.window().help().look_in({handbook.folder()});
  Student student(desktop);
  student.open_own(1);
  student.go_on();
  desktop.wait_until_idle();
  auto* dock = desktop.window().findChild<QDockWidget*>("lesson");
  QVERIFY(dock && dock->isVisible());
  first_that_takes_keys(*dock->widget())->setFocus();
  desktop.press(Qt::Key_F1);
  QCOMPARE(browser.page(handbook), QString("panels/lesson.html"));
  Desktop::keep_picture(*dock);
}

void HelpStoryTest::dialogs_have_theirs() {
  const Handbook handbook;
  Browser browser;
  Desktop desktop(story_executor(), {1100, 700});
  desktop.window().help().look_in({handbook.folder()});
  bool done = false;
  QTimer::singleShot(0, this, [&] {
    auto* dialog = qobject_cast<ui::KeysDialog*>(QApplication::activeModalWidget());
    if (!dialog || !QTest::qWaitForWindowActive(dialog)) return;
    auto* table = dialog->findChild<QTableWidget*>();
    table->setFocus();
    QTest::keyClick(table, Qt::Key_F1);
    const QString page = browser.page(handbook);
    // There it is entered, and opens nothing.
    auto* key = dialog->findChild<QKeySequenceEdit*>();
    key->setFocus();
    QTest::keyClick(key, Qt::Key_F1);
    done = page == "window.html" && browser.page(handbook).isEmpty();
    dialog->reject();
  });
  desktop.window().actions().keys->trigger();
  QVERIFY(done);
}

void HelpStoryTest::without_a_panel_it_is_the_first_page() {
  const Handbook handbook;
  Browser browser;
  Desktop desktop(story_executor(), {1100, 700});
  desktop.window().help().look_in({handbook.folder()});
  desktop.press(Qt::Key_F1);
  QCOMPARE(browser.page(handbook), QString("first-page.html"));
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.view<ui::SliceViewWidget>("Axial")->setFocus();
  desktop.press(Qt::Key_F1);
  QCOMPARE(browser.page(handbook), QString("first-page.html"));
  desktop.choose("Help", desktop.menu_entry("Help", "Handbook"));
  QCOMPARE(browser.page(handbook), QString("first-page.html"));
}

void HelpStoryTest::pages_in_the_language_of_the_program_come_first() {
  Handbook handbook;
  handbook.add("de/first-page.html");
  Browser browser;
  const Variable language("TIDEMARK_STORY_LANGUAGE", "de");
  Desktop desktop(story_executor(), {1100, 700});
  desktop.window().help().look_in({handbook.folder()});
  desktop.press(Qt::Key_F1);
  QCOMPARE(browser.page(handbook), QString("de/first-page.html"));
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.window().panels().show("level-set");
  desktop.wait_until_idle();
  auto* dock = desktop.window().findChild<QDockWidget*>("level-set");
  first_that_takes_keys(*dock->widget())->setFocus();
  desktop.press(Qt::Key_F1);
  QCOMPARE(browser.page(handbook), QString("panels/level-set.html"));  // not translated
}

void HelpStoryTest::without_a_handbook_a_message_says_where_it_is() {
  Browser browser;
  Desktop desktop(story_executor(), {1100, 700});
  desktop.window().help().look_in({"/nowhere"});
  desktop.press(Qt::Key_F1);
  const auto* bar = desktop.window().findChild<ui::MessageBar*>();
  QVERIFY2(bar->isVisible() && bar->text().contains("handbook"), qPrintable(bar->text()));
}

TIDEMARK_TEST(HelpStoryTest)

}  // namespace tidemark::test::help_story_test

#include "help_story_test.moc"
