#include "ui/panels/paint_panel.h"

#include <QAction>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QSignalSpy>
#include <QToolButton>

#include "tests/support/test_program.h"
#include "tests/ui/panels/panel_case.h"

namespace tidemark::test::paint_panel_test {

class PaintPanelTest : public QObject {
  Q_OBJECT
 private slots:
  void init() {
    the_case_ = std::make_unique<PanelCase>();
    panel_ = shown<ui::PaintPanel>(*the_case_, 500);
  }
  void cleanup() {
    panel_.reset();
    the_case_.reset();
  }

  void a_tool_is_chosen_and_the_one_before_remembered() {
    QTest::mouseClick(named<QToolButton>(*panel_, tr("Paint")), Qt::LeftButton);
    QCOMPARE(settings().tool, engine::Tool::paint);
    QTest::mouseClick(named<QToolButton>(*panel_, tr("Erase")), Qt::LeftButton);
    QCOMPARE(settings().tool, engine::Tool::erase);
    QCOMPARE(settings().last_tool, engine::Tool::paint);
    QVERIFY(!named<QToolButton>(*panel_, tr("Paint"))->isChecked());
  }

  void with_another_tool_neither_is_chosen() {
    QTest::mouseClick(named<QToolButton>(*panel_, tr("Paint")), Qt::LeftButton);
    the_case_->proxy->display().choose_tool(engine::Tool::measure_angle);
    QVERIFY(!named<QToolButton>(*panel_, tr("Paint"))->isChecked());
    QVERIFY(!named<QToolButton>(*panel_, tr("Erase"))->isChecked());
  }

  void the_radius_is_shown_in_voxels_of_each_axis() {
    auto* radius = named<QDoubleSpinBox>(*panel_, tr("Radius"));
    radius->setFocus();
    radius->selectAll();
    QTest::keyClicks(radius, "8");
    QTest::keyClick(radius, Qt::Key_Return);
    QCOMPARE(settings().brush_mm, 8.0);
    const QLocale locale;
    QCOMPARE(named<QLabel>(*panel_, tr("In voxels"))->text(),
             QStringLiteral("%1 × %1 × %2").arg(locale.toString(8.0, 'f', 1), locale.toString(4.0, 'f', 1)));
  }

  void the_radius_follows_the_wheel_in_a_view() {
    the_case_->proxy->display().change([](engine::DisplaySettings& s) { s.brush_mm = 2.5; });
    QCOMPARE(named<QDoubleSpinBox>(*panel_, tr("Radius"))->value(), 2.5);
  }

  void undo_and_redo_are_the_windows() {
    QAction undo(tr("Undo paint"));
    QAction redo(tr("Redo"));
    redo.setEnabled(false);
    panel_->set_actions(&undo, &redo);
    QSignalSpy spy(&undo, &QAction::triggered);
    QTest::mouseClick(button<QToolButton>(*panel_, tr("Undo paint")), Qt::LeftButton);
    QCOMPARE(spy.count(), 1);
    QVERIFY(!button<QToolButton>(*panel_, tr("Redo"))->isEnabled());
  }

  void the_session_may_die() {
    the_case_->proxy.reset();
    QVERIFY(!named<QToolButton>(*panel_, tr("Paint"))->isEnabled());
  }

 private:
  const engine::DisplaySettings& settings() { return the_case_->proxy->display().settings(); }

  std::unique_ptr<PanelCase> the_case_;
  std::unique_ptr<ui::PaintPanel> panel_;
};

TIDEMARK_TEST(PaintPanelTest)

}  // namespace tidemark::test::paint_panel_test

#include "paint_panel_test.moc"
