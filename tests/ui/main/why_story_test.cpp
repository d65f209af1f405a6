// "Why here?" by mouse and keys: the balance of the terms at a place, in slices and in 3D, and what turns it.
#include <QLabel>
#include <QObject>
#include <QPushButton>
#include <glm/geometric.hpp>

#include "engine/case_balance.h"
#include "solver/surface_places.h"
#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "ui/look/theme.h"
#include "ui/panels/balance_bars.h"
#include "ui/panels/balance_controls.h"
#include "ui/panels/speed_plot.h"

namespace tidemark::test::why_story_test {
namespace {

constexpr double kRadius = 10.0;

// A part of the panel that is seen.
template <class Widget>
Widget* seen(Desktop& desktop) {
  for (auto* widget : desktop.window().findChildren<Widget*>()) {
    if (!widget->visibleRegion().isEmpty()) return widget;
  }
  return nullptr;
}

QString why(Desktop& desktop) {
  auto* controls = seen<ui::BalanceControls>(desktop);
  if (!controls) return {};
  QString text;
  for (const QLabel* label : controls->findChildren<QLabel*>()) text += label->text() + '\n';
  return text;
}

double phi_there(Desktop& desktop, glm::dvec3 place_mm) {
  const solver::Field& phi = *desktop.state().phi;
  return solver::phi_at(phi, phi.geometry.to_voxel(place_mm));
}

}  // namespace

class WhyStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void a_place_is_explained_turned_and_followed_data();
  void a_place_is_explained_turned_and_followed();
  void a_place_in_3d_is_explained_and_the_pointer_asks();
  void the_place_that_moves_most_is_a_key_away();
  void arrows_show_the_terms_in_slices_and_3d();
  void a_case_is_closed_while_it_is_explained();

 private:
  static const engine::ExplainedPlace* place(Desktop& desktop) {
    const auto& place = desktop.proxy().balance().place();
    return place ? &*place : nullptr;
  }
};

void WhyStoryTest::a_place_is_explained_turned_and_followed_data() {
  add_executor_rows();
}

void WhyStoryTest::a_place_is_explained_turned_and_followed() {
  QFETCH(int, executor);
  const Variable renderer("TIDEMARK_RENDERER", renderer_beside(static_cast<solver::ExecutorKind>(executor)));
  Desktop desktop(static_cast<solver::ExecutorKind>(executor), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.begin(kRadius);
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  QVERIFY(axial);
  const glm::dvec3 seed = desktop.seed_mm();
  desktop.proxy().display().change([&](engine::DisplaySettings& s) { s.cursor_mm = seed; });
  desktop.press(Qt::Key_Y);
  QCOMPARE(desktop.proxy().display().settings().tool, engine::Tool::why);
  QVERIFY(why(desktop).contains("click on the surface"));
  // A little beside the outline: the place is on it.
  Desktop::drag(*axial, {seed + glm::dvec3(kRadius + 1.0, 0.0, 0.0)});
  QVERIFY(Desktop::wait_for([&] { return place(desktop) != nullptr; }));
  QVERIFY(std::abs(glm::distance(place(desktop)->place_mm, seed) - kRadius) < 0.5);
  QVERIFY(glm::dot(place(desktop)->outward, glm::dvec3(1.0, 0.0, 0.0)) > 0.95);

  // The panel has the bars, the sentence, and the brightness on the tent.
  desktop.wait_until_idle();
  auto* bars = seen<ui::BalanceBars>(desktop);
  auto* tent = seen<ui::SpeedPlot>(desktop);
  QVERIFY(bars && tent);
  QVERIFY(bars->bars().size() >= 4);
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < bars->bars().size(); ++i) sum += bars->bars()[i].push_mm;
  QVERIFY(std::abs(sum - bars->bars().back().push_mm) < 1e-12);
  QVERIFY(tent->mark().has_value());
  QCOMPARE(*tent->mark(), place(desktop)->balance.intensity);
  QVERIFY2(why(desktop).contains("outward"), qPrintable(why(desktop)));
  desktop.screenshot(QStringLiteral("why-%1-1-clicked").arg(executor));

  // The next step does what the sum says.
  const glm::dvec3 at = place(desktop)->place_mm;
  const double foretold = place(desktop)->balance.pushes.sum() * place(desktop)->time_step;
  const double before = phi_there(desktop, at);
  QVERIFY(std::abs(foretold) > 1e-3);
  desktop.press(Qt::Key_Period);
  QVERIFY(Desktop::wait_for([&] { return desktop.state().step == 1; }));
  desktop.wait_until_idle();
  const double change = phi_there(desktop, at) - before;
  QVERIFY2(std::abs(change - foretold) <= 0.01 * std::abs(change),
           qPrintable(QStringLiteral("foretold %1, computed %2").arg(foretold).arg(change)));

  // What the sentence names turns it.
  QVERIFY(place(desktop)->sum_mm() > 0.0);
  const auto turn = place(desktop)->to_inward;
  QVERIFY(turn.alpha);
  const solver::Parameters first = desktop.state().parameters;
  solver::Parameters turned = first;
  turned.alpha = std::max(0.0, *turn.alpha - 0.02);
  desktop.proxy().set_parameters(turned);
  QVERIFY(Desktop::wait_for([&] { return place(desktop) && place(desktop)->sum_mm() < 0.0; }));
  desktop.wait_until_idle();
  QVERIFY2(why(desktop).contains("would move it outward"), qPrintable(why(desktop)));
  desktop.screenshot(QStringLiteral("why-%1-2-turned").arg(executor));
  desktop.proxy().set_parameters(first);

  // The place goes with the front until it rests.
  desktop.press(Qt::Key_P);
  QVERIFY(Desktop::wait_for([&] { return desktop.state().converged && !desktop.state().playing; }, 120000));
  desktop.wait_until_idle();
  QVERIFY(place(desktop));
  QVERIFY(std::abs(place(desktop)->balance.phi) < 0.1);
  QVERIFY(std::abs(phi_there(desktop, place(desktop)->place_mm)) < 0.1);
  QVERIFY(glm::distance(place(desktop)->place_mm, seed) > kRadius + 1.0);
  QVERIFY(std::abs(place(desktop)->balance.pushes.sum()) < 0.1);
  desktop.screenshot(QStringLiteral("why-%1-3-at-rest").arg(executor));

  // Far from the surface there is nothing to explain; then nothing is asked any more.
  Desktop::drag(*axial, {seed});
  QVERIFY(Desktop::wait_for([&] { return place(desktop) == nullptr; }));
  desktop.wait_until_idle();
  QVERIFY2(why(desktop).contains("no surface near"), qPrintable(why(desktop)));
  for (auto* button : desktop.window().findChildren<QPushButton*>()) {
    if (button->text() == "Clear" && !button->visibleRegion().isEmpty())
      QTest::mouseClick(button, Qt::LeftButton);
  }
  QVERIFY(!desktop.proxy().balance().asked());
}

void WhyStoryTest::a_place_in_3d_is_explained_and_the_pointer_asks() {
  const Variable renderer("TIDEMARK_RENDERER", renderer_beside(story_executor()));
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.begin(kRadius);
  auto* volume = desktop.view<ui::VolumeViewWidget>();
  QVERIFY(volume);
  const glm::dvec3 seed = desktop.seed_mm();
  desktop.press(Qt::Key_Y);
  const QPoint middle = volume->position_of(seed).toPoint();
  QTest::mousePress(volume, Qt::LeftButton, {}, middle);
  QVERIFY(Desktop::wait_for([&] { return place(desktop) != nullptr; }));
  QTest::mouseRelease(volume, Qt::LeftButton, {}, middle);
  desktop.wait_until_idle();
  const renderer::Camera& camera = desktop.proxy().display().settings().camera;
  const glm::dvec3 facing = glm::cross(camera.right(), camera.up());
  QVERIFY(std::abs(glm::distance(place(desktop)->place_mm, seed) - kRadius) < 0.5);
  QVERIFY(glm::dot(place(desktop)->outward, facing) > 0.9);
  QVERIFY(volume->shows(place(desktop)->place_mm, place(desktop)->outward));
  desktop.screenshot("why-3d");

  // With another tool the pointer asks while Ctrl is held, in slices and in 3D.
  desktop.press(Qt::Key_W);
  desktop.proxy().balance().forget();
  const auto point = [](QWidget& view, QPointF at, Qt::KeyboardModifiers held) {
    QMouseEvent move(QEvent::MouseMove, at, view.mapToGlobal(at), Qt::NoButton, Qt::NoButton, held);
    QApplication::sendEvent(&view, &move);
  };
  point(*volume, middle + QPoint(4, 0), {});
  desktop.wait_until_idle();
  QVERIFY(!desktop.proxy().balance().asked());
  point(*volume, middle + QPoint(6, 0), Qt::ControlModifier);
  QVERIFY(Desktop::wait_for([&] { return place(desktop) != nullptr; }));
  QVERIFY(glm::dot(place(desktop)->outward, facing) > 0.9);
  point(*volume, middle + QPoint(8, 0), {});
  QVERIFY(!desktop.proxy().balance().asked());
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  const glm::dvec3 edge = seed + glm::dvec3(0.0, kRadius, 0.0);
  desktop.proxy().display().change([&](engine::DisplaySettings& s) { s.cursor_mm = seed; });
  point(*axial, axial->position_of(edge), Qt::ControlModifier);
  QVERIFY(Desktop::wait_for(
      [&] { return place(desktop) && glm::distance(place(desktop)->place_mm, edge) < 1.0; }));
}

void WhyStoryTest::the_place_that_moves_most_is_a_key_away() {
  const Variable renderer("TIDEMARK_RENDERER", renderer_beside(story_executor()));
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("tumour"));
  desktop.begin(7.0);
  desktop.proxy().step(30);
  desktop.wait_until_idle();
  desktop.press(Qt::Key_F);
  QVERIFY(Desktop::wait_for([&] { return place(desktop) != nullptr; }));
  desktop.wait_until_idle();
  const engine::ExplainedPlace& there = *place(desktop);
  QVERIFY(glm::distance(desktop.proxy().display().settings().cursor_mm, there.place_mm) < 1e-6);
  QVERIFY(std::abs(there.balance.phi) < 0.1);
  const auto inputs = *engine::step_inputs(desktop.state());
  for (const glm::dvec3& other : solver::surface_places(*inputs.phi, std::nullopt, 6.0)) {
    const double moves = std::abs(solver::PlaceBalance(inputs, other).balance().pushes.sum());
    QVERIFY(moves < 1.15 * std::abs(there.balance.pushes.sum()));
  }
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  QVERIFY(axial->shows(there.place_mm, there.outward));
  QVERIFY(seen<ui::BalanceBars>(desktop));
  desktop.screenshot("why-fastest");
}

void WhyStoryTest::arrows_show_the_terms_in_slices_and_3d() {
  const Variable renderer("TIDEMARK_RENDERER", renderer_beside(story_executor()));
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("tumour"));
  desktop.begin(9.0);
  desktop.proxy().display().change([&](engine::DisplaySettings& s) { s.cursor_mm = desktop.seed_mm(); });
  desktop.wait_until_idle();
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  auto* volume = desktop.view<ui::VolumeViewWidget>();
  const QImage slice = axial->grab_picture();
  const QImage surface = volume->grab_picture();
  desktop.press(Qt::Key_O);
  QVERIFY(desktop.proxy().display().settings().forces);
  desktop.wait_until_idle();
  QVERIFY(difference(slice, axial->grab_picture()) > 0.002);
  QVERIFY(difference(surface, volume->grab_picture()) > 0.002);
  desktop.screenshot("why-arrows-light");
  ui::apply_theme(*qApp, ui::Theme::dark);
  desktop.press(Qt::Key_F);
  desktop.wait_until_idle();
  desktop.screenshot("why-arrows-dark");
  ui::apply_theme(*qApp, ui::Theme::light);

  // They move with the surface.
  const QImage before = axial->grab_picture();
  desktop.proxy().step(20);
  desktop.wait_until_idle();
  QVERIFY(difference(before, axial->grab_picture()) > 0.002);
  desktop.screenshot("why-arrows-later");
  desktop.press(Qt::Key_O);
  QVERIFY(!desktop.proxy().display().settings().forces);
}

void WhyStoryTest::a_case_is_closed_while_it_is_explained() {
  Desktop desktop(story_executor(), {1000, 700});
  for (int round = 0; round < 3; ++round) {
    QVERIFY(desktop.open_phantom("sphere"));
    desktop.begin(kRadius);
    desktop.proxy().set_pause_at_convergence(false);
    desktop.press(Qt::Key_O);
    desktop.press(Qt::Key_P);
    QVERIFY(Desktop::wait_for([&] { return desktop.state().step > 3; }));
    desktop.press(Qt::Key_F);
    if (round > 0) QVERIFY(Desktop::wait_for([&] { return place(desktop) != nullptr; }));
    Desktop::answer(QMessageBox::Discard);
    desktop.press(Qt::Key_W, Qt::ControlModifier);
    QVERIFY(Desktop::wait_for([&] { return desktop.window().cases().isEmpty(); }));
  }
  desktop.wait_until_idle();
}

TIDEMARK_TEST(WhyStoryTest)

}  // namespace tidemark::test::why_story_test

#include "why_story_test.moc"
