// Session files, opened one after the other.
#include <QPushButton>
#include <QStatusBar>

#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "ui/main/message_bar.h"
#include "ui/main/session_reader.h"
#include "ui/widgets/status_progress.h"

namespace tidemark::test::session_story_test {

class SessionStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void a_session_that_is_given_up_lets_the_next_one_open() {
    const TemporaryFolder folder;
    const auto path = [&](const char* name) { return QString::fromStdString((folder / name).string()); };
    Desktop desktop(solver::ExecutorKind::host, {900, 640});
    QVERIFY(desktop.open_phantom("sphere"));
    desktop.begin(9.0);
    QVERIFY(desktop.save_session(path("slow.tidemark")));
    desktop.close_case();
    std::filesystem::copy_file(folder / "slow.tidemark", folder / "next.tidemark");
    const auto shown = [&]() -> ui::StatusProgress* {
      for (auto* view : desktop.window().statusBar()->findChildren<ui::StatusProgress*>()) {
        if (view->isVisible()) return view;
      }
      return nullptr;
    };
    ui::SessionReader& reader = desktop.window().session_reader();
    reader.open(path("slow.tidemark"));
    reader.open(path("next.tidemark"));
    QVERIFY(reader.reads(path("slow.tidemark")));
    QVERIFY(shown());
    shown()->findChild<QPushButton*>()->click();
    QVERIFY(!reader.reads(path("slow.tidemark")));
    QVERIFY(reader.reads(path("next.tidemark")));
    QVERIFY(Desktop::wait_for([&] { return desktop.window().cases().size() == 1; }));
    desktop.wait_until_idle();
    QVERIFY(!shown());
    QCOMPARE(desktop.window().cases().size(), 1);
    QCOMPARE(desktop.window().active_case()->session_file, path("next.tidemark"));
    QCOMPARE(desktop.window().findChild<ui::MessageBar*>()->text(), QString());
  }
};

TIDEMARK_TEST(SessionStoryTest)

}  // namespace tidemark::test::session_story_test

#include "session_story_test.moc"
