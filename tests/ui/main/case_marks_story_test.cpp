// Two patients open at once: panels, messages and links say of which case they are.
#include <QLabel>
#include <QMenu>
#include <QMenuBar>
#include <QPointer>

#include "imaging/files/volume_file.h"
#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "ui/look/theme.h"
#include "ui/main/case_head.h"
#include "ui/main/message_bar.h"

namespace tidemark::test::case_marks_story_test {

class CaseMarksStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void panels_say_whose_case_they_act_on();
  void the_window_menu_lists_the_open_cases();
  void linked_cases_show_it_and_links_end_with_them();
  void linked_cases_of_two_modalities_keep_their_windows();
  void linked_files_of_unknown_modality_keep_their_windows();
  void a_message_says_of_which_case_it_is_and_goes_with_it();

 private:
  // Side by side; the first one is active, by a click on one of its views.
  static QList<ui::CaseWindow*> open_two(Desktop& desktop, const QString& first, const QString& second);
  static void click(ui::CaseWindow& window);
};

QList<ui::CaseWindow*> CaseMarksStoryTest::open_two(Desktop& desktop, const QString& first,
                                                    const QString& second) {
  QList<ui::CaseWindow*> cases{desktop.open_phantom(first), desktop.open_phantom(second)};
  desktop.window().actions().tile->trigger();
  desktop.wait_until_idle();
  click(*cases[0]);
  desktop.wait_until_idle();
  return cases;
}

void CaseMarksStoryTest::click(ui::CaseWindow& window) {
  ui::PictureView* view = window.views().first();
  QTest::mouseClick(view, Qt::LeftButton, {}, view->rect().center());
}

void CaseMarksStoryTest::panels_say_whose_case_they_act_on() {
  Desktop desktop(story_executor(), {1300, 800});
  const auto cases = open_two(desktop, "sphere", "tumour");
  QCOMPARE(cases[0]->number(), 1);
  QCOMPARE(cases[1]->number(), 2);
  QVERIFY(ui::case_colour(cases[0]->number()) != ui::case_colour(cases[1]->number()));
  for (const int turn : {0, 1, 0}) {
    click(*cases[turn]);
    desktop.wait_until_idle();
    auto* own = cases[turn]->findChild<ui::CaseHead*>();
    QVERIFY(own && own->isVisible());
    QVERIFY2(own->text().contains(cases[turn]->proxy().name()), qPrintable(own->text()));
    int shown = 0;
    for (auto* head : desktop.window().findChildren<ui::CaseHead*>()) {
      if (cases[0]->isAncestorOf(head) || cases[1]->isAncestorOf(head)) continue;
      QCOMPARE(head->text(), own->text());
      if (head->visibleRegion().isEmpty()) continue;
      ++shown;
      // The colour of the case's window is the panel's.
      QCOMPARE(head->grab().toImage().pixelColor(head->width() / 2, head->height() - 1).rgb(),
               ui::case_colour(cases[turn]->number()).rgb());
    }
    QCOMPARE(shown, 1);
    QCOMPARE(own->grab().toImage().pixelColor(own->width() / 2, own->height() - 1).rgb(),
             ui::case_colour(cases[turn]->number()).rgb());
  }
  desktop.screenshot("two-patients");
}

// Behind others, or made small, a case comes back by its name.
void CaseMarksStoryTest::the_window_menu_lists_the_open_cases() {
  Desktop desktop(story_executor(), {1300, 800});
  const auto cases = open_two(desktop, "sphere", "tumour");
  QMenuBar* bar = desktop.window().menuBar();
  QAction* title = nullptr;
  for (QAction* one : bar->actions()) {
    if (one->menu()->actions().contains(desktop.window().actions().tile)) title = one;
  }
  QVERIFY(title);
  QMenu* menu = title->menu();
  // The entry of a case in the open menu.
  const auto entry_of = [&](int turn) -> QAction* {
    QTest::mouseClick(bar, Qt::LeftButton, {}, bar->actionGeometry(title).center());
    if (!Desktop::wait_for([&] { return menu->isVisible(); })) return nullptr;
    const QString name = cases[turn]->proxy().name();
    for (QAction* entry : menu->actions()) {
      if (entry->text() == QString("&%1  %2").arg(turn + 1).arg(name)) return entry;
    }
    return nullptr;
  };
  const qsizetype without_cases = menu->actions().size();
  cases[1]->parentWidget()->showMinimized();
  desktop.wait_until_idle();
  for (const int turn : {0, 1, 0}) {
    QAction* entry = entry_of(turn);
    QVERIFY(entry && entry->isVisible());
    QVERIFY(!entry->isChecked());
    QCOMPARE(menu->actions().size(), without_cases + 3);  // with a line before them
    QTest::mouseClick(menu, Qt::LeftButton, {}, menu->actionGeometry(entry).center());
    desktop.wait_until_idle();
    QCOMPARE(desktop.window().active_case(), cases[turn]);
    QVERIFY(!cases[turn]->parentWidget()->isMinimized());
    entry = entry_of(turn);
    QVERIFY(entry && entry->isChecked());
    desktop.screenshot("window-menu");
    QTest::keyClick(menu, Qt::Key_Escape);
  }
}

void CaseMarksStoryTest::linked_cases_show_it_and_links_end_with_them() {
  Desktop desktop(story_executor(), {1300, 800});
  auto cases = open_two(desktop, "tumour", "tumour");
  const auto linked = [&] { return desktop.window().actions().link->isChecked(); };
  QVERIFY(!linked() && !cases[0]->linked());
  desktop.press(Qt::Key_L);
  QVERIFY(linked() && cases[0]->linked() && cases[1]->linked());

  // Another one is not linked until the user says so.
  ui::CaseWindow* third = desktop.open_phantom("tumour");
  desktop.wait_until_idle();
  QVERIFY(!third->linked() && !linked());
  const WindowLevel before = third->proxy().display().settings().window;
  cases[0]->proxy().display().change([](engine::DisplaySettings& s) { s.window.centre += 55.0; });
  QVERIFY(third->proxy().display().settings().window == before);

  // What remains of a pair is free.
  for (ui::CaseWindow* window : {cases[0], third}) {
    QPointer<ui::CaseWindow> closed(window);
    window->close_saved();
    QVERIFY(Desktop::wait_for([&] { return closed.isNull(); }));
  }
  desktop.wait_until_idle();
  QVERIFY(!cases[1]->linked() && !linked());
  ui::CaseWindow* next = desktop.open_phantom("tumour");
  desktop.wait_until_idle();
  QVERIFY(!next->linked() && !linked());
  next->proxy().display().change([](engine::DisplaySettings& s) { s.camera.azimuth = 12.0; });
  QVERIFY(cases[1]->proxy().display().settings().camera.azimuth != 12.0);
}

void CaseMarksStoryTest::linked_cases_of_two_modalities_keep_their_windows() {
  Desktop desktop(story_executor(), {1300, 800});
  const auto cases = open_two(desktop, "tumour", "organ");
  QVERIFY(cases[0]->proxy().volume().modality != cases[1]->proxy().volume().modality);
  const WindowLevel of_other = cases[1]->proxy().display().settings().window;
  desktop.press(Qt::Key_L);
  cases[0]->proxy().display().change([](engine::DisplaySettings& s) {
    s.window.centre += 77.0;
    s.camera.azimuth = 12.0;
  });
  QVERIFY(cases[1]->proxy().display().settings().window == of_other);
  QCOMPARE(cases[1]->proxy().display().settings().camera.azimuth, 12.0);
}

void CaseMarksStoryTest::linked_files_of_unknown_modality_keep_their_windows() {
  const TemporaryFolder folder;
  const auto write = [&](const char* name, std::int16_t step) {
    Volume volume;
    volume.geometry.size = Index3(24);
    std::vector<std::int16_t> voxels;
    for (std::int64_t offset = 0; offset < volume.geometry.voxel_count(); ++offset) {
      voxels.push_back(static_cast<std::int16_t>(step * (offset % 24)));
    }
    volume.voxels = std::move(voxels);
    const Status written = imaging::write_volume_file(volume, folder / name);
    if (!written) qFatal("%s", written.error().message.c_str());
    return QString::fromStdString((folder / name).string());
  };
  Desktop desktop(story_executor(), {1300, 800});
  const QString first = write("first.nrrd", 1);
  QList<ui::CaseWindow*> cases;
  for (const QString& file : {first, write("second.nrrd", 100), first}) {
    cases << desktop.open(file);
    QVERIFY(cases.back());
    desktop.wait_until_idle();
  }
  desktop.window().actions().tile->trigger();
  desktop.wait_until_idle();
  const auto window_of = [&](int number) { return cases[number]->proxy().display().settings().window; };
  click(*cases[0]);
  const WindowLevel of_other = window_of(1);
  desktop.press(Qt::Key_L);
  cases[0]->proxy().display().change([](engine::DisplaySettings& s) { s.window.centre += 3.0; });
  QVERIFY(window_of(1) == of_other);
  QVERIFY(window_of(2) == window_of(0));  // the same study once more
}

void CaseMarksStoryTest::a_message_says_of_which_case_it_is_and_goes_with_it() {
  Desktop desktop(story_executor(), {1300, 800});
  const auto cases = open_two(desktop, "sphere", "tumour");
  auto& bar = *desktop.window().findChild<ui::MessageBar*>();
  // In the case that is not active.
  cases[1]->proxy().begin_from_label(77);
  QVERIFY(Desktop::wait_for([&] { return !bar.text().isEmpty(); }));
  QCOMPARE(desktop.window().active_case(), cases[0]);
  const auto marks = [&] {
    QStringList names;
    for (const QLabel* label : bar.findChildren<QLabel*>()) {
      if (label->isVisible() && label->accessibleName().startsWith("Case ")) names << label->accessibleName();
    }
    return names.join(", ");
  };
  QCOMPARE(marks(), QString("Case 2"));
  desktop.screenshot("message-of-the-other-case");
  QPointer<ui::CaseWindow> closed(cases[1]);
  cases[1]->close_saved();
  QVERIFY(Desktop::wait_for([&] { return closed.isNull(); }));
  QCOMPARE(bar.text(), QString());
  // What is no case's has no mark.
  desktop.window().tell("A sentence.");
  QCOMPARE(bar.text(), QString("A sentence."));
  QCOMPARE(marks(), QString());
}

TIDEMARK_TEST(CaseMarksStoryTest)

}  // namespace tidemark::test::case_marks_story_test

#include "case_marks_story_test.moc"
