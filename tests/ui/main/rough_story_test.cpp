// What must not break: cases that go while they are busy, storms of events, and a graphics context that is
// lost.
#include <QApplication>
#include <QDockWidget>
#include <cmath>
#include <vector>

#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"

namespace tidemark::test::rough_story_test {

class RoughStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void a_case_is_closed_while_it_plays();
  void the_window_is_closed_while_a_case_plays();
  void the_window_is_closed_while_a_phantom_is_computed();
  void a_hundred_sizes_end_with_the_right_picture();
  void views_go_before_their_pictures_arrive();
  void another_study_is_opened_while_one_plays();
  void executors_are_changed_while_it_plays();
  void keys_of_undo_and_redo_are_hammered_while_it_plays();
  void a_lost_context_is_made_good_data();
  void a_lost_context_is_made_good();

 private:
  static void play(Desktop& desktop);
  static bool advances(Desktop& desktop, std::int64_t by);
};

// Plays on: without a rest at convergence.
void RoughStoryTest::play(Desktop& desktop) {
  desktop.begin(10.0);
  desktop.proxy().set_pause_at_convergence(false);
  desktop.press(Qt::Key_P);
  QVERIFY(Desktop::wait_for([&] { return desktop.state().playing && desktop.state().step > 3; }));
}

bool RoughStoryTest::advances(Desktop& desktop, std::int64_t by) {
  const std::int64_t from = desktop.state().step;
  return Desktop::wait_for([&] { return desktop.state().step > from + by; });
}

void RoughStoryTest::a_case_is_closed_while_it_plays() {
  Desktop desktop(story_executor(), {900, 640});
  for (int round = 0; round < 3; ++round) {
    QVERIFY(desktop.open_phantom("sphere"));
    play(desktop);
    Desktop::answer(QMessageBox::Cancel);
    desktop.press(Qt::Key_W, Qt::ControlModifier);
    QCOMPARE(desktop.window().cases().size(), 1);
    QVERIFY(advances(desktop, 1));
    Desktop::answer(QMessageBox::Discard);
    desktop.press(Qt::Key_W, Qt::ControlModifier);
    QVERIFY(Desktop::wait_for([&] { return desktop.window().cases().isEmpty(); }));
    QVERIFY(Desktop::wait_for([&] { return desktop.engine().idle(); }));
  }
  QCOMPARE(desktop.engine().contexts_made(), 1);
}

void RoughStoryTest::the_window_is_closed_while_a_case_plays() {
  Desktop desktop(solver::ExecutorKind::compute, {900, 640});
  QVERIFY(desktop.open_phantom("sphere"));
  play(desktop);
  Desktop::answer(QMessageBox::Discard);
  QVERIFY(desktop.window().close());
  QVERIFY(!desktop.window().isVisible());
  QVERIFY(Desktop::wait_for([&] { return desktop.engine().idle(); }));
}

void RoughStoryTest::the_window_is_closed_while_a_phantom_is_computed() {
  for (const int wait : {0, 1, 20, 200}) {
    Desktop desktop(story_executor(), {900, 640});
    desktop.window().open_phantom("tumour");
    QTest::qWait(wait);
    QVERIFY(desktop.window().close());
  }
}

void RoughStoryTest::a_hundred_sizes_end_with_the_right_picture() {
  Desktop desktop(story_executor(), {900, 640});
  QVERIFY(desktop.open_phantom("sphere"));
  play(desktop);
  for (int index = 0; index < 100; ++index) {
    desktop.window().resize(700 + 7 * (index * 37 % 100), 520 + 3 * (index * 53 % 100));
    QTest::qWait(index % 10 == 0 ? 30 : 2);
  }
  QVERIFY(advances(desktop, 3));
  desktop.proxy().pause();
  QVERIFY(Desktop::wait_for([&] { return !desktop.state().playing; }));
  desktop.wait_until_idle();
  for (ui::PictureView* view : desktop.window().active_case()->views()) {
    QVERIFY2(shows_a_picture(*view), qPrintable(view->title()));
    QVERIFY(view->feed().shown().finished);
    QCOMPARE(view->feed().shown().step, desktop.state().step);
    QCOMPARE(view->feed().shown().image.width(), static_cast<int>(view->physical_size().width));
    QCOMPARE(view->feed().shown().image.height(), static_cast<int>(view->physical_size().height));
  }
}

void RoughStoryTest::views_go_before_their_pictures_arrive() {
  Desktop desktop(story_executor(), {900, 640});
  QVERIFY(desktop.open_phantom("sphere"));
  play(desktop);
  ui::CaseWindow& window = *desktop.window().active_case();
  const std::vector<ui::ViewKind> kinds{ui::ViewKind::volume, ui::ViewKind::pages, ui::ViewKind::oblique,
                                        ui::ViewKind::coronal};
  for (int round = 0; round < 24; ++round) {
    QVERIFY(window.add_view(kinds[static_cast<std::size_t>(round) % kinds.size()]));
    if (round % 3 == 0) QTest::qWait(round);
    window.set_layout(round % 2 == 0 ? ui::ViewLayout::single : ui::ViewLayout::paper);
  }
  QCOMPARE(window.views().size(), 3);
  QVERIFY(advances(desktop, 3));
  desktop.proxy().pause();
  QVERIFY(Desktop::wait_for([&] { return !desktop.state().playing; }));
  desktop.wait_until_idle();
  for (ui::PictureView* view : window.views()) QVERIFY2(shows_a_picture(*view), qPrintable(view->title()));
}

void RoughStoryTest::another_study_is_opened_while_one_plays() {
  Desktop desktop(story_executor(), {900, 640});
  ui::CaseWindow* first = desktop.open_phantom("sphere");
  QVERIFY(first);
  play(desktop);
  const std::int64_t step = desktop.state().step;
  desktop.window().open_phantom("tumour");
  QVERIFY(Desktop::wait_for([&] { return desktop.window().cases().size() == 2; }));
  QVERIFY(Desktop::wait_for([&] { return desktop.window().active_case() != first; }));
  QVERIFY(first->proxy().state().step > step);
  for (ui::PictureView* view : desktop.window().active_case()->views())
    QVERIFY(Desktop::wait_for([&] { return view->feed().shown().size == view->physical_size(); }));
  QVERIFY(first->proxy().state().playing);
  QCOMPARE(desktop.engine().contexts_made(), 1);
}

void RoughStoryTest::executors_are_changed_while_it_plays() {
  Desktop desktop(story_executor(), {900, 640});
  QVERIFY(desktop.open_phantom("sphere"));
  play(desktop);
  const std::vector<std::pair<solver::ExecutorKind, QString>> kinds{
      {solver::ExecutorKind::compute, "compute"},
      {solver::ExecutorKind::stream, "stream"},
      {solver::ExecutorKind::host, "host"}};
  for (const auto& [kind, name] : kinds) {
    const QString& wanted = name;  // clang before 16 captures no structured binding
    const std::int64_t step = desktop.state().step;
    desktop.proxy().change_executor(kind);
    QVERIFY(Desktop::wait_for([&] { return desktop.state().executor == wanted; }));
    QVERIFY(desktop.state().step >= step);
    QVERIFY(desktop.state().playing);
    QVERIFY(advances(desktop, 5));
  }
  desktop.proxy().pause();
  QVERIFY(Desktop::wait_for([&] { return !desktop.state().playing; }));
  desktop.wait_until_idle();
  for (ui::PictureView* view : desktop.window().active_case()->views()) QVERIFY(shows_a_picture(*view));
}

void RoughStoryTest::keys_of_undo_and_redo_are_hammered_while_it_plays() {
  Desktop desktop(story_executor(), {900, 640});
  QVERIFY(desktop.open_phantom("sphere"));
  play(desktop);
  desktop.proxy().pause();
  QVERIFY(Desktop::wait_for([&] { return !desktop.state().playing; }));
  desktop.wait_until_idle();
  const std::int64_t step = desktop.state().step;
  const double volume_ml = desktop.state().surface.volume_ml;
  QVERIFY(step > 0 && volume_ml > 0.0);
  // Undo ends the evolution, which is a state of the history from then on.
  for (const Qt::KeyboardModifiers more : {Qt::NoModifier, Qt::ShiftModifier}) {
    desktop.press(Qt::Key_Z, Qt::ControlModifier | more);
    desktop.wait_until_idle();
  }
  const std::uint64_t played = desktop.state().history_state;
  QCOMPARE(desktop.state().step, step);
  for (int round = 0; round < 60; ++round) {
    if (round % 7 == 0) desktop.press(Qt::Key_P);
    const bool undo = round % 5 < 3;
    desktop.press(Qt::Key_Z, undo ? Qt::ControlModifier : Qt::ControlModifier | Qt::ShiftModifier);
    if (round % 4 == 0) QTest::qWait(round % 9);
  }
  desktop.proxy().pause();
  desktop.wait_until_idle();
  QVERIFY(!desktop.state().playing);
  // All the way back there is no surface; forwards there is one again.
  for (int guard = 0; guard < 200 && !desktop.state().undo_text.isEmpty(); ++guard) {
    desktop.press(Qt::Key_Z, Qt::ControlModifier);
    desktop.wait_until_idle();
  }
  QVERIFY(desktop.state().undo_text.isEmpty());
  QVERIFY(!desktop.state().begun);
  desktop.press(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  desktop.wait_until_idle();
  QVERIFY(desktop.state().begun);
  QCOMPARE(desktop.state().step, 0);
  // What was there before is there still.
  desktop.proxy().go_to(played);
  desktop.wait_until_idle();
  QCOMPARE(desktop.state().step, step);
  QVERIFY(std::abs(desktop.state().surface.volume_ml - volume_ml) < 1e-9);
}

void RoughStoryTest::a_lost_context_is_made_good_data() {
  add_executor_rows({solver::ExecutorKind::compute});
}

void RoughStoryTest::a_lost_context_is_made_good() {
  QFETCH(int, executor);
  const Variable renderer("TIDEMARK_RENDERER", "gl");
  Desktop desktop(static_cast<solver::ExecutorKind>(executor), {900, 640});
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.begin(10.0);
  // Another case on the same context.
  QVERIFY(desktop.open_phantom("sphere"));
  play(desktop);
  ui::CaseWindow* resting = desktop.window().cases().first();
  QVERIFY(resting != desktop.window().active_case());
  QStringList failures;
  connect(&desktop.proxy(), &engine::CaseProxy::failed, this, [&](const QString& text) { failures << text; });
  int contexts = 1;
  for (const int checks : {1, 3, 11}) {
    QCOMPARE(desktop.engine().contexts_made(), contexts);
    engine::Engine& engine = desktop.engine();
    engine.post(engine::Priority::edit, this,
                [&engine, checks](const std::stop_token&) { engine.device()->lose_at_check(checks); });
    QVERIFY2(Desktop::wait_for([&] { return engine.contexts_made() == contexts + 1; }),
             qPrintable(QString("after %1 checks").arg(checks)));
    ++contexts;
    QVERIFY(desktop.state().playing);
    QVERIFY(advances(desktop, 3));
    for (ui::PictureView* view : desktop.window().active_case()->views()) {
      const std::uint64_t pictures = view->feed().shown().number;
      QVERIFY(Desktop::wait_for([&] { return view->feed().shown().number > pictures + 1; }));
    }
  }
  desktop.proxy().pause();
  QVERIFY(Desktop::wait_for([&] { return !desktop.state().playing; }));
  desktop.wait_until_idle();
  for (ui::PictureView* view : desktop.window().active_case()->views()) QVERIFY(shows_a_picture(*view));
  // The other case draws on the new context, too.
  desktop.window().actions().tile->trigger();
  desktop.wait_until_idle();
  for (ui::PictureView* view : resting->views()) QVERIFY(shows_a_picture(*view));
  qInfo("%d contexts; told: %s", contexts, qPrintable(failures.join("; ")));
  QVERIFY(failures.isEmpty());
  disconnect(&desktop.proxy(), nullptr, this, nullptr);
}

TIDEMARK_TEST(RoughStoryTest)

}  // namespace tidemark::test::rough_story_test

#include "rough_story_test.moc"
