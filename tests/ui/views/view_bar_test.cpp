// T and epsilon in the bar over a view.
#include "ui/views/view_bar.h"

#include "tests/support/test_program.h"
#include "tests/ui/panels/panel_case.h"

using namespace tidemark;

class ViewBarTest : public QObject {
  Q_OBJECT

  std::unique_ptr<test::PanelCase> the_case_;
  std::unique_ptr<ui::ViewBar> bar_;

  QDoubleSpinBox& box(const QString& name) { return *test::named<QDoubleSpinBox>(*bar_, name); }

  // As if it had been double-clicked, and not finished yet.
  static void type(QDoubleSpinBox& into, const QString& text) {
    into.setFocus();
    into.selectAll();
    QTest::keyClicks(&into, text);
  }

 private slots:
  void init() {
    the_case_ = std::make_unique<test::PanelCase>();
    bar_ = std::make_unique<ui::ViewBar>(*the_case_->proxy, "Axial", QList<QAction*>(), QList<QAction*>());
    bar_->resize(600, 30);
    test::show(*bar_);
  }
  void cleanup() {
    bar_.reset();
    the_case_.reset();
  }

  void a_number_can_be_typed_while_the_surface_moves_data() {
    QTest::addColumn<QString>("name");
    QTest::newRow("T") << "Target T";
    QTest::newRow("epsilon") << "Range epsilon";
  }
  void a_number_can_be_typed_while_the_surface_moves() {
    QFETCH(QString, name);
    type(box(name), "12");
    the_case_->begin(5.0);
    the_case_->proxy->step(3);
    the_case_->wait_until_idle();
    QTest::keyClicks(&box(name), "3");
    QTest::keyClick(&box(name), Qt::Key_Return);
    the_case_->wait_until_idle();
    const solver::Parameters now = the_case_->state().parameters;
    QCOMPARE(name == "Target T" ? now.target : now.range, 123.0);
  }

  void a_change_of_one_leaves_the_others_digits() {
    solver::Parameters parameters = the_case_->proxy->parameters();
    parameters.target = 40.123456;
    parameters.range = 30.123456;
    the_case_->proxy->set_parameters(parameters);
    the_case_->wait_until_idle();
    type(box("Target T"), "77");
    QTest::keyClick(&box("Target T"), Qt::Key_Return);
    the_case_->wait_until_idle();
    QCOMPARE(the_case_->state().parameters.target, 77.0);
    QCOMPARE(the_case_->state().parameters.range, 30.123456);
    type(box("Range epsilon"), "20");
    QTest::keyClick(&box("Range epsilon"), Qt::Key_Return);
    the_case_->wait_until_idle();
    QCOMPARE(the_case_->state().parameters.target, 77.0);
    QCOMPARE(the_case_->state().parameters.range, 20.0);
  }

  void it_follows_what_is_set_elsewhere() {
    solver::Parameters parameters = the_case_->proxy->parameters();
    parameters.target = 55.0;
    parameters.range = 11.0;
    the_case_->proxy->set_parameters(parameters);
    the_case_->wait_until_idle();
    QCOMPARE(box("Target T").value(), 55.0);
    QCOMPARE(box("Range epsilon").value(), 11.0);
  }
};

TIDEMARK_TEST(ViewBarTest)
#include "view_bar_test.moc"
