// The panel "Passes": a page through a step, from live data, while it rests, steps and plays.
#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QToolButton>
#include <glm/geometric.hpp>

#include "engine/case_passes.h"
#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "tests/ui/main/story_language.h"
#include "ui/look/theme.h"
#include "ui/passes/pass_cards.h"
#include "ui/passes/passes_panel.h"

namespace tidemark::test::passes_story_test {
namespace {

constexpr double kRadius = 10.0;

const engine::RecordedStep* recorded(Desktop& desktop) {
  return desktop.proxy().passes().recorded().get();
}

QString texts(QWidget& in) {
  QString all;
  for (const QLabel* label : in.findChildren<QLabel*>()) {
    if (label->isVisibleTo(&in)) all += label->text() + '\n';
  }
  return all;
}

// The picture of a panel by its name, the last one of that name.
const ui::TexelPicture* picture(ui::PassesPanel& panel, const QString& name) {
  const ui::TexelPicture* found = nullptr;
  for (const ui::TexelPicture* one : panel.findChildren<ui::TexelPicture*>()) {
    if (one->accessibleName() == name) found = one;
  }
  return found;
}

ui::PassesPanel* open_passes(Desktop& desktop) {
  desktop.choose(in_story_language("Ev&olution"), desktop.window().actions().passes);
  auto* panel = desktop.window().findChild<ui::PassesPanel*>();
  return Desktop::wait_for([&] { return panel->isVisible(); }) ? panel : nullptr;
}

// The new phi of the record is phi of the page in the case.
bool came_true(const solver::PassRecord& record, const solver::Field& phi) {
  const Index3 first = record.layout.first_voxel(record.page);
  for (int y = 0; y < record.valid().y; ++y) {
    for (int x = 0; x < record.valid().x; ++x) {
      if (record.next[static_cast<std::size_t>(x + 16 * y)] != phi.at(first + Index3(x, y, 0))) return false;
    }
  }
  return true;
}

}  // namespace

class PassesStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void a_page_is_followed_through_its_steps();
  void it_follows_while_it_plays_and_changes_nothing();
  void the_panel_offers_the_stream_executor();
  void a_window_of_its_own_has_room_for_all();
};

void PassesStoryTest::a_page_is_followed_through_its_steps() {
  const auto stream = solver::ExecutorKind::stream;
  const Variable renderer("TIDEMARK_RENDERER", renderer_beside(stream));
  Desktop desktop(stream, {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.begin(kRadius);
  ui::PassesPanel* panel = open_passes(desktop);
  QVERIFY(panel);
  // A click of the crosshair tool on the surface chooses the page.
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  const glm::dvec3 edge = desktop.seed_mm() + glm::dvec3(kRadius, 0.0, 0.0);
  desktop.press(Qt::Key_C);
  Desktop::drag(*axial, {edge});
  const auto page_there = [&] {
    const Geometry& geometry = desktop.proxy().volume().geometry;
    const PageLayout layout(geometry.size, {16, 16, 1});
    const glm::dvec3 voxel = geometry.to_voxel(desktop.proxy().display().settings().cursor_mm);
    return layout.translate(Index3(glm::round(voxel))).page;
  };
  QVERIFY(
      Desktop::wait_for([&] { return recorded(desktop) && recorded(desktop)->record.page == page_there(); }));
  QVERIFY(recorded(desktop)->record.is_resident());
  QVERIFY(recorded(desktop)->record.message.is_mixed());
  desktop.wait_until_idle();
  QVERIFY2(texts(*panel).contains("Step 1, read back"), qPrintable(texts(*panel)));
  QVERIFY2(texts(*panel).contains("is physical page"), qPrintable(texts(*panel)));
  QCOMPARE(picture(*panel, "Substreams")->content().values[0], 5.0F);   // a corner
  QCOMPARE(picture(*panel, "Substreams")->content().values[1], 3.0F);   // an edge
  QCOMPARE(picture(*panel, "Substreams")->content().values[17], 0.0F);  // the interior
  desktop.screenshot("passes-1-first");

  // Single steps do what the panel has shown, and it goes on to the next.
  for (int step = 1; step <= 3; ++step) {
    const solver::PassRecord foretold = recorded(desktop)->record;
    for (auto* button : panel->findChildren<QToolButton*>()) {
      if (button->defaultAction() == desktop.window().actions().step)
        QTest::mouseClick(button, Qt::LeftButton);
    }
    QVERIFY(Desktop::wait_for([&] { return desktop.state().step == step; }));
    QVERIFY(Desktop::wait_for([&] { return recorded(desktop) && recorded(desktop)->step == step; }));
    desktop.wait_until_idle();
    QVERIFY(came_true(foretold, *desktop.state().phi));
  }
  auto* scroll = panel->findChild<QScrollArea*>();
  scroll->verticalScrollBar()->setValue(scroll->verticalScrollBar()->maximum() / 2);
  desktop.screenshot("passes-2-middle");
  scroll->verticalScrollBar()->setValue(scroll->verticalScrollBar()->maximum());
  desktop.screenshot("passes-3-message");

  // Far from the surface there is no page.
  desktop.proxy().display().change([&](engine::DisplaySettings& s) {
    s.cursor_mm = desktop.proxy().volume().geometry.to_patient(glm::dvec3(0.0));
  });
  QVERIFY(Desktop::wait_for([&] { return recorded(desktop) && !recorded(desktop)->record.is_resident(); }));
  desktop.wait_until_idle();
  QVERIFY2(texts(*panel).contains("is not resident"), qPrintable(texts(*panel)));
  QVERIFY(picture(*panel, "data")->content().values.empty());
}

void PassesStoryTest::it_follows_while_it_plays_and_changes_nothing() {
  const auto stream = solver::ExecutorKind::stream;
  const Variable renderer("TIDEMARK_RENDERER", renderer_beside(stream));
  Desktop desktop(stream, {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.begin(7.0);
  ui::PassesPanel* panel = open_passes(desktop);
  QVERIFY(panel);
  auto* follow = panel->findChild<QComboBox*>();
  follow->setFocus();
  QTest::keyClick(follow, Qt::Key_Down);
  QVERIFY(Desktop::wait_for(
      [&] { return desktop.proxy().passes().follow() == engine::CasePasses::Follow::motion; }));
  QVERIFY(
      Desktop::wait_for([&] { return recorded(desktop) && recorded(desktop)->record.message.is_mixed(); }));
  desktop.proxy().set_pause_at_convergence(false);
  desktop.proxy().play();
  std::int64_t last = recorded(desktop)->step;
  for (int seen = 0; seen < 4; ++seen) {
    QVERIFY(Desktop::wait_for([&] { return recorded(desktop) && recorded(desktop)->step > last; }));
    last = recorded(desktop)->step;
  }
  QVERIFY(Desktop::wait_for([&] { return desktop.state().step > 60; }, 60000));
  desktop.proxy().pause();
  desktop.wait_until_idle();
  QVERIFY(Desktop::wait_for([&] { return recorded(desktop)->step == desktop.state().step; }));
  desktop.screenshot("passes-4-played");
  const std::int64_t steps = desktop.state().step;
  const auto watched = desktop.state().phi->dense();
  // The same steps with nobody who looks.
  desktop.window().findChild<QDockWidget*>("passes")->close();
  desktop.press(Qt::Key_Home);
  QVERIFY(Desktop::wait_for([&] { return desktop.state().step == 0; }));
  desktop.proxy().step(steps);
  QVERIFY(Desktop::wait_for([&] { return desktop.state().step == steps; }, 60000));
  desktop.wait_until_idle();
  QVERIFY(desktop.state().phi->dense() == watched);
}

void PassesStoryTest::the_panel_offers_the_stream_executor() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  ui::PassesPanel* panel = open_passes(desktop);
  QVERIFY(panel);
  QVERIFY2(texts(*panel).contains("Once there is a surface"), qPrintable(texts(*panel)));
  desktop.begin(kRadius);
  desktop.choose(in_story_language("Ev&olution"),
                 desktop.window().actions().passes);  // the panel that steers came to the front
  QVERIFY(Desktop::wait_for([&] { return panel->isVisible(); }));
  desktop.proxy().step(5);
  QVERIFY(Desktop::wait_for([&] { return desktop.state().step == 5; }));
  desktop.wait_until_idle();
  auto* use = panel->findChild<QPushButton*>();
  if (story_executor() != solver::ExecutorKind::stream) {
    const auto before = desktop.state().phi->dense();
    QVERIFY(use->isVisible());
    QVERIFY2(texts(*panel).contains("This surface is computed by"), qPrintable(texts(*panel)));
    desktop.screenshot("passes-5-other-executor");
    QTest::mouseClick(use, Qt::LeftButton);
    QVERIFY(Desktop::wait_for([&] { return desktop.state().executor == "stream"; }));
    desktop.wait_until_idle();
    QVERIFY(desktop.state().phi->dense() == before);
    QCOMPARE(desktop.state().step, std::int64_t{5});
  }
  QVERIFY(Desktop::wait_for([&] { return recorded(desktop) != nullptr; }));
  QVERIFY(!use->isVisible());
  // A case that is closed meanwhile leaves nothing behind.
  desktop.window().active_case()->close_saved();
  QVERIFY(Desktop::wait_for([&] { return desktop.window().active_case() == nullptr; }));
}

void PassesStoryTest::a_window_of_its_own_has_room_for_all() {
  const auto stream = solver::ExecutorKind::stream;
  const Variable renderer("TIDEMARK_RENDERER", renderer_beside(stream));
  Desktop desktop(stream, {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.begin(9.0);
  ui::PassesPanel* panel = open_passes(desktop);
  QVERIFY(panel);
  desktop.proxy().passes().set_follow(engine::CasePasses::Follow::motion);
  desktop.proxy().step(11);
  QVERIFY(Desktop::wait_for([&] { return recorded(desktop) && recorded(desktop)->step == 11; }));
  auto* dock = desktop.window().findChild<QDockWidget*>("passes");
  dock->setFloating(true);
  QVERIFY(Desktop::wait_for([&] { return panel->cards().columns() == 3; }));
  QVERIFY(dock->width() <= 1366 && dock->height() <= 768);
  desktop.wait_until_idle();
  QCOMPARE(panel->findChild<QScrollArea*>()->verticalScrollBar()->maximum(), 0);
  const QString folder = qEnvironmentVariable("TIDEMARK_SCREENSHOTS");
  for (const ui::Theme theme : {ui::Theme::light, ui::Theme::dark}) {
    ui::apply_theme(*qApp, theme);
    QCoreApplication::processEvents();
    const QImage shown = panel->grab().toImage();
    QVERIFY(!shown.isNull());
    if (!folder.isEmpty())
      QVERIFY(
          shown.save(folder + (theme == ui::Theme::light ? "/passes-6-light.png" : "/passes-6-dark.png")));
  }
  ui::apply_theme(*qApp, ui::Theme::light);
}

TIDEMARK_TEST(PassesStoryTest)

}  // namespace tidemark::test::passes_story_test

#include "passes_story_test.moc"
