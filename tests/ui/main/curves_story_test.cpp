// Figures that predict and judge: a ball's law, distances to a truth, gradients, and phi along a line.
#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QObject>
#include <QPushButton>
#include <QScrollArea>
#include <QToolButton>
#include <glm/geometric.hpp>

#include "solver/ball.h"
#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "ui/look/theme.h"
#include "ui/panels/curve_legend.h"
#include "ui/panels/curve_plot.h"
#include "ui/panels/evolution_curves.h"
#include "ui/panels/evolution_figures.h"
#include "ui/panels/gradient_figures.h"
#include "ui/panels/gradient_plot.h"
#include "ui/panels/profile_controls.h"
#include "ui/panels/profile_plot.h"

namespace tidemark::test::curves_story_test {
namespace {

// By its accessible name, else by its text.
template <class Widget>
Widget* named(QWidget& in, const QString& name) {
  Widget* by_text = nullptr;
  for (Widget* widget : in.findChildren<Widget*>()) {
    if (widget->accessibleName() == name) return widget;
    if (widget->property("text").toString() == name) by_text = widget;
  }
  return by_text;
}

// A part of the panel Level set, with its end in sight.
template <class Part>
Part* part(Desktop& desktop) {
  auto* found = desktop.window().findChild<Part*>();
  for (QWidget* above = found ? found->parentWidget() : nullptr; above; above = above->parentWidget()) {
    auto* scroll = qobject_cast<QScrollArea*>(above);
    if (!scroll) continue;
    QCoreApplication::processEvents();
    const QPoint end = found->mapTo(scroll->widget(), QPoint(0, found->height()));
    scroll->ensureVisible(0, end.y(), 0, 4);
    QCoreApplication::processEvents();
  }
  return found;
}

double radius_mm(Desktop& desktop) {
  return solver::radius_of_ball_mm(desktop.state().surface.volume_ml);
}

int pixels(ui::PictureView& view, const std::function<bool(const QColor&)>& counts) {
  const QImage picture = view.grab_picture();
  int count = 0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) count += counts(picture.pixelColor(x, y)) ? 1 : 0;
  }
  return count;
}
bool is_blue(const QColor& colour) {
  return colour.blue() > colour.red() + 25;
}
bool is_orange(const QColor& colour) {
  return colour.red() > colour.blue() + 40 && colour.red() > colour.green() + 30;
}

void in_both_themes(Desktop& desktop, const QString& name) {
  desktop.screenshot(name + "-light");
  ui::apply_theme(*qApp, ui::Theme::dark);
  desktop.screenshot(name + "-dark");
  ui::apply_theme(*qApp, ui::Theme::light);
}

}  // namespace

class CurvesStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void a_ball_follows_its_law_until_it_meets_other_tissue();
  void distances_to_the_truth_are_told_and_seen();
  void the_gradient_is_counted_while_it_is_open();
  void phi_along_a_line_is_plotted_and_moves();
};

void CurvesStoryTest::a_ball_follows_its_law_until_it_meets_other_tissue() {
  const Variable renderer("TIDEMARK_RENDERER", renderer_beside(story_executor()));
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.begin(8.0);
  auto* curves = part<ui::EvolutionCurves>(desktop);
  QVERIFY(curves);
  auto* volume = named<ui::CurvePlot>(*curves, "Volume");
  auto* area = named<ui::CurvePlot>(*curves, "Area");
  auto* legend = curves->findChild<ui::CurveLegend*>();
  QVERIFY(Desktop::wait_for([&] { return volume->predicted().size() > 10; }));
  QVERIFY(legend->isVisible());
  QCOMPARE(legend->predicted(), QStringLiteral("dR/dt = αD − 2(1−α)/R"));
  QVERIFY(legend->toolTip().contains("The law ends at step"));
  QCOMPARE(area->predicted().size(), volume->predicted().size());
  QVERIFY(std::abs(volume->predicted().front().y() - desktop.state().surface.volume_ml) < 1e-9);
  part<ui::EvolutionCurves>(desktop);
  in_both_themes(desktop, "curves-1-start");

  // Steps by hand, of which the curve has each: it keeps to the law.
  for (int i = 0; i < 5; ++i) {
    const std::int64_t before = desktop.state().step;
    desktop.press(Qt::Key_Period, Qt::NoModifier);
    QVERIFY(Desktop::wait_for([&] { return desktop.state().step > before; }));
  }
  desktop.proxy().step(25);
  desktop.wait_until_idle();
  const auto at = [](const std::vector<QPointF>& points, double step) {
    for (std::size_t i = 1; i < points.size(); ++i) {
      if (points[i].x() < step) continue;
      const double share = (step - points[i - 1].x()) / (points[i].x() - points[i - 1].x());
      return points[i - 1].y() + share * (points[i].y() - points[i - 1].y());
    }
    return 0.0;
  };
  const double measured = volume->points().back().y();
  const double foretold = at(volume->predicted(), volume->points().back().x());
  QCOMPARE(volume->points().back().x(), 30.0);
  QVERIFY2(std::abs(measured / foretold - 1.0) < 0.1,
           qPrintable(QStringLiteral("measured %1 ml, predicted %2 ml").arg(measured).arg(foretold)));
  QVERIFY(measured > 1.3 * volume->points().front().y());
  auto* radius = named<QLabel>(*curves, "Radius");
  QVERIFY2(radius && radius->text().contains("predicted"), qPrintable(radius ? radius->text() : QString()));
  part<ui::EvolutionCurves>(desktop);
  in_both_themes(desktop, "curves-2-thirty-steps");

  // Another alpha is typed: the law begins anew where the surface is.
  auto* alpha = named<QDoubleSpinBox>(desktop.window(), "Data weight α");
  alpha->setFocus();
  alpha->selectAll();
  QTest::keyClicks(alpha, "0");
  QTest::keyClick(alpha, Qt::Key_Return);
  QVERIFY(Desktop::wait_for([&] { return legend->predicted() == QStringLiteral("R = √(R₀² − 4(1−α)t)"); }));
  QCOMPARE(volume->predicted().front().x(), 30.0);
  desktop.proxy().step(40);
  desktop.wait_until_idle();
  QVERIFY(volume->points().back().y() < 0.9 * measured);
  const double shrunk = at(volume->predicted(), volume->points().back().x());
  QVERIFY(std::abs(volume->points().back().y() / shrunk - 1.0) < 0.1);
  part<ui::EvolutionCurves>(desktop);
  in_both_themes(desktop, "curves-3-curvature-alone");

  // What is no ball has no law.
  desktop.proxy().paint({desktop.seed_mm() + glm::dvec3(radius_mm(desktop), 0.0, 0.0), 4.0},
                        solver::Brush::add, engine::CaseProxy::new_gesture());
  QVERIFY(Desktop::wait_for([&] { return volume->predicted().empty() && !legend->isVisible(); }));
  QVERIFY(Desktop::wait_for([&] { return volume->toolTip().contains("not one ball"); }));
}

void CurvesStoryTest::distances_to_the_truth_are_told_and_seen() {
  const Variable renderer("TIDEMARK_RENDERER", renderer_beside(story_executor()));
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("tumour"));
  desktop.begin(12.0);
  desktop.proxy().display().change([&](engine::DisplaySettings& s) { s.cursor_mm = desktop.seed_mm(); });
  auto* figures = part<ui::EvolutionFigures>(desktop);
  QVERIFY(figures);
  auto* mean = named<QLabel>(*figures, "Mean distance");
  auto* most = named<QLabel>(*figures, "Hausdorff 95");
  QVERIFY(Desktop::wait_for([&] { return mean->text().contains("mm") && most->text().contains("mm"); }));
  const QString mean_before = mean->text();
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  auto* volume = desktop.view<ui::VolumeViewWidget>();
  const int blue_before = pixels(*axial, is_blue);
  auto* shown = named<QCheckBox>(*figures, "Distances to the truth");
  QVERIFY(shown);
  QTest::mouseClick(shown, Qt::LeftButton, {}, QPoint(8, shown->height() / 2));
  QVERIFY(desktop.proxy().display().settings().truth_error);
  QVERIFY(Desktop::wait_for([&] { return pixels(*axial, is_blue) > blue_before + 300; }));
  desktop.wait_until_idle();
  QVERIFY(pixels(*volume, is_blue) > 500);
  in_both_themes(desktop, "truth-1-too-little");

  // It grows: less is missing, and distances fall.
  desktop.press(Qt::Key_P);
  QVERIFY(Desktop::wait_for([&] { return desktop.state().dice && *desktop.state().dice > 0.9; }, 60000));
  desktop.proxy().pause();
  desktop.wait_until_idle();
  QVERIFY(Desktop::wait_for([&] { return mean->text() != mean_before; }));
  auto* dice = named<ui::CurvePlot>(desktop.window(), "Dice");
  QVERIFY(dice && dice->isVisible());
  QVERIFY(dice->points().size() > 1);
  QCOMPARE(dice->points().back().y(), *desktop.state().dice);
  part<ui::EvolutionFigures>(desktop);
  in_both_themes(desktop, "truth-2-grown");

  // Too much of it is orange.
  const int orange_before = pixels(*axial, is_orange);
  desktop.proxy().paint({desktop.seed_mm() + glm::dvec3(0.0, 42.0, 0.0), 12.0}, solver::Brush::add,
                        engine::CaseProxy::new_gesture());
  desktop.wait_until_idle();
  QVERIFY(Desktop::wait_for([&] { return pixels(*axial, is_orange) > orange_before + 150; }));
  desktop.screenshot("truth-3-too-much");
  QTest::mouseClick(shown, Qt::LeftButton, {}, QPoint(8, shown->height() / 2));
  QVERIFY(Desktop::wait_for([&] { return pixels(*axial, is_orange) < orange_before + 100; }));
}

void CurvesStoryTest::the_gradient_is_counted_while_it_is_open() {
  const Variable renderer("TIDEMARK_RENDERER", renderer_beside(story_executor()));
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.begin(8.0);
  auto* figures = part<ui::GradientFigures>(desktop);
  QVERIFY(figures);
  auto* plot = figures->findChild<ui::GradientPlot*>();
  QVERIFY(!plot->isVisible());
  desktop.proxy().step(5);
  desktop.wait_until_idle();
  QVERIFY(!plot->histogram());  // nobody looks
  auto* fold = named<QToolButton>(*figures, "Gradient of φ");
  QVERIFY(fold);
  QTest::mouseClick(fold, Qt::LeftButton);
  QVERIFY(Desktop::wait_for([&] { return plot->histogram() && plot->histogram()->near.voxels > 100; }));
  QVERIFY(std::abs(plot->histogram()->near.mean - 1.0) < 0.1);
  const auto before = plot->histogram();
  desktop.press(Qt::Key_P);
  QVERIFY(Desktop::wait_for([&] { return plot->histogram() && !(plot->histogram() == before); }));
  desktop.proxy().pause();
  desktop.wait_until_idle();
  part<ui::GradientFigures>(desktop);
  in_both_themes(desktop, "gradient");
  QTest::mouseClick(fold, Qt::LeftButton);
  QVERIFY(!plot->isVisible());
}

void CurvesStoryTest::phi_along_a_line_is_plotted_and_moves() {
  const Variable renderer("TIDEMARK_RENDERER", renderer_beside(story_executor()));
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.begin(8.0);
  const glm::dvec3 seed = desktop.seed_mm();
  desktop.proxy().display().change([&](engine::DisplaySettings& s) { s.cursor_mm = seed; });
  desktop.wait_until_idle();
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  desktop.press(Qt::Key_J);
  QCOMPARE(desktop.proxy().display().settings().tool, engine::Tool::profile);
  auto* controls = part<ui::ProfileControls>(desktop);
  QVERIFY(controls);
  const glm::dvec3 half(25.0, 0.0, 0.0);
  Desktop::drag(*axial, {seed - half, seed, seed + half});
  auto* plot = controls->findChild<ui::ProfilePlot*>();
  QVERIFY(Desktop::wait_for([&] { return plot->isVisible(); }));
  desktop.wait_until_idle();
  const auto& crossings = plot->content().profile.crossings_mm;
  QCOMPARE(crossings.size(), std::size_t{2});
  QVERIFY(std::abs(crossings[1] - crossings[0] - 16.0) < 0.3);
  QVERIFY(std::abs(plot->content().length_mm - 50.0) < 1.0);
  QVERIFY(!plot->visibleRegion().isEmpty());  // it has come to sight
  in_both_themes(desktop, "profile-1-start");

  desktop.press(Qt::Key_P);
  QVERIFY(Desktop::wait_for([&] { return desktop.state().step > 20; }, 60000));
  desktop.proxy().pause();
  desktop.wait_until_idle();
  const auto& later = plot->content().profile.crossings_mm;
  QCOMPARE(later.size(), std::size_t{2});
  QVERIFY(std::abs(later[1] - later[0] - 2.0 * radius_mm(desktop)) < 1.0);
  QVERIFY(later[1] - later[0] > 18.0);
  in_both_themes(desktop, "profile-2-grown");

  Desktop::drag(*axial, {seed});  // a click
  QVERIFY(!desktop.proxy().display().settings().profile);
  QVERIFY(!plot->isVisible());
  Desktop::drag(*axial, {seed, seed + half});
  QVERIFY(desktop.proxy().display().settings().profile);
  auto* clear = named<QPushButton>(*controls, "Clear");
  QVERIFY(clear && clear->isVisible());
  QTest::mouseClick(clear, Qt::LeftButton);
  QVERIFY(!desktop.proxy().display().settings().profile);
}

TIDEMARK_TEST(CurvesStoryTest)

}  // namespace tidemark::test::curves_story_test

#include "curves_story_test.moc"
