// The figures of an evolution, and its curves over the steps.
#include "ui/panels/evolution_figures.h"

#include <QLabel>
#include <algorithm>

#include "tests/support/test_program.h"
#include "tests/ui/panels/panel_case.h"
#include "ui/panels/curve_plot.h"
#include "ui/panels/evolution_curves.h"

namespace tidemark::test::evolution_figures_test {

class EvolutionFiguresTest : public QObject {
  Q_OBJECT

 private slots:
  void distances_to_the_truth_go_with_the_surface() {
    PanelCase the_case;
    const Geometry& grid = the_case.proxy->volume().geometry;
    auto truth = std::make_shared<BitMask>(grid);
    for (std::int64_t n = 0; n < grid.voxel_count(); ++n) {
      const Index3 away = grid.voxel_at(n) - grid.size / std::int64_t{2};
      const bool is_inside = away.x * away.x + away.y * away.y + 4 * away.z * away.z < 100;
      if (is_inside) truth->add(n);
    }
    the_case.proxy->compare_with(truth);
    the_case.begin(6.0);
    const auto figures = shown<ui::EvolutionFigures>(the_case, 400);
    auto* mean = named<QLabel>(*figures, "Mean distance");
    auto* most = named<QLabel>(*figures, "Hausdorff 95");
    QTRY_VERIFY(mean->text().contains("mm") && most->text().contains("mm"));
    the_case.proxy->undo();
    the_case.wait_until_idle();
    QVERIFY(!the_case.state().begun);
    QCOMPARE(mean->text(), QStringLiteral("–"));
    QCOMPARE(most->text(), QStringLiteral("–"));
  }

  void a_curve_ends_with_its_newest_value() {
    ui::CurvePlot plot("Motion", {}, true);
    plot.resize(200, 80);
    plot.set_steps({1.0, 3.0});
    plot.set_points({{1.0, 0.9}, {2.0, 0.5}, {3.0, 0.0}});
    QCOMPARE(plot.accessibleDescription(), QString("0"));
    QCOMPARE(plot.points().back().x(), 3.0);
    const QImage stopped = plot.grab().toImage();
    plot.set_points({{1.0, 0.9}, {2.0, 0.5}});
    QCOMPARE(plot.accessibleDescription(), QString("0.50"));
    QVERIFY(plot.grab().toImage() != stopped);
    plot.set_points({{1.0, 0.0}});
    QCOMPARE(plot.accessibleDescription(), QString("0"));
    QVERIFY(!plot.grab().isNull());
  }

  void a_step_has_one_place_in_all_curves() {
    PanelCase the_case;
    the_case.begin(6.0);
    const auto curves = shown<ui::EvolutionCurves>(the_case, 400);
    auto* volume = named<ui::CurvePlot>(*curves, "Volume");
    auto* motion = named<ui::CurvePlot>(*curves, "Motion");
    QCOMPARE(motion->last_text(), QStringLiteral("–"));  // before the first step
    for (int step = 0; step < 5; ++step) {
      the_case.proxy->step();
      the_case.wait_until_idle();
    }
    QVERIFY(motion->points().size() > 1);
    QCOMPARE(motion->points().back().x(), volume->points().back().x());
    QVERIFY(motion->steps() == volume->steps());
    QCOMPARE(volume->steps().first, 0.0);
    double last = volume->points().back().x();
    if (!volume->predicted().empty()) last = std::max(last, volume->predicted().back().x());
    QCOMPARE(volume->steps().last, last);
  }
};

TIDEMARK_TEST(EvolutionFiguresTest)

}  // namespace tidemark::test::evolution_figures_test

#include "evolution_figures_test.moc"
