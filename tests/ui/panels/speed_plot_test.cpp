// The tent in the panel Level set, moved by mouse and keys.
#include "ui/panels/speed_plot.h"

#include <QDoubleSpinBox>

#include "tests/support/test_program.h"
#include "tests/ui/panels/panel_case.h"
#include "ui/panels/level_set_panel.h"

namespace tidemark::test::speed_plot_test {

class SpeedPlotTest : public QObject {
  Q_OBJECT
 private slots:
  void init() {
    the_case_ = std::make_unique<PanelCase>();
    panel_ = shown<ui::LevelSetPanel>(*the_case_, 900);
  }
  void cleanup() {
    panel_.reset();
    the_case_.reset();
  }

  void the_peak_of_the_tent_moves_t_alone() {
    auto& tent = *panel_->findChild<ui::SpeedPlot*>();
    const QPoint peak = tent.peak().toPoint();
    drag(tent, peak, peak - QPoint(40, 0));
    the_case_->wait_until_idle();
    const solver::Parameters& parameters = the_case_->state().parameters;
    QVERIFY(parameters.target < 95.0);
    QCOMPARE(parameters.range, 50.0);
    the_case_->proxy->undo();
    the_case_->wait_until_idle();
    QCOMPARE(the_case_->state().parameters.target, 100.0);
    QVERIFY(the_case_->state().undo_text.isEmpty());
  }

  void a_foot_of_the_tent_changes_epsilon_alone() {
    auto& tent = *panel_->findChild<ui::SpeedPlot*>();
    const QPoint foot = tent.left_foot().toPoint();
    drag(tent, foot, foot + QPoint(20, 30));
    the_case_->wait_until_idle();
    const solver::Parameters& parameters = the_case_->state().parameters;
    QVERIFY(parameters.range < 48.0);
    QCOMPARE(parameters.target, 100.0);
    QCOMPARE(parameters.range, named<QDoubleSpinBox>(*panel_, tr("Range ε"))->value());
  }

  void a_press_beside_the_tents_handles_changes_nothing() {
    auto& tent = *panel_->findChild<ui::SpeedPlot*>();
    drag(tent, {40, tent.height() - 20}, {90, tent.height() - 20});
    QCOMPARE(the_case_->proxy->parameters(), the_case_->proxy->study().parameters);
  }

  void arrow_keys_move_the_tent() {
    auto& tent = *panel_->findChild<ui::SpeedPlot*>();
    tent.setFocus();
    QTest::keyClick(&tent, Qt::Key_Left);
    QVERIFY(the_case_->proxy->parameters().target < 100.0);
    QTest::keyClick(&tent, Qt::Key_Up);
    QVERIFY(the_case_->proxy->parameters().range > 50.0);
  }

 private:
  std::unique_ptr<PanelCase> the_case_;
  std::unique_ptr<ui::LevelSetPanel> panel_;
};

TIDEMARK_TEST(SpeedPlotTest)

}  // namespace tidemark::test::speed_plot_test

#include "speed_plot_test.moc"
