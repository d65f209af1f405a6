// T and epsilon in the bar over a view.
#include "ui/views/view_bar.h"

#include <QAction>
#include <QApplication>
#include <QScopeGuard>

#include "tests/support/test_program.h"
#include "tests/ui/panels/panel_case.h"
#include "ui/look/icons.h"
#include "ui/views/speed_map_choice.h"

namespace tidemark::test::view_bar_test {

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
    bar_ = std::make_unique<ui::ViewBar>(*the_case_->proxy, "Axial", QList<QAction*>());
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

  void a_narrow_bar_leaves_parts_out_and_cuts_none_data() {
    QTest::addColumn<double>("type");
    QTest::newRow("normal") << 1.0;
    QTest::newRow("for a projector") << 1.5;
  }
  void a_narrow_bar_leaves_parts_out_and_cuts_none() {
    QFETCH(double, type);
    QAction tool(ui::icon(u"tool-window"), "Window");
    ui::ViewBar bar(*the_case_->proxy, "Speed map", {&tool});
    auto* choice = new ui::SpeedMapChoice(*the_case_->proxy, &bar);
    bar.add_choice(choice);
    bar.resize(600, 30);
    test::show(bar);
    QVERIFY(!choice->isVisible());  // brightness alone has no doubt
    const auto show_term = [&](renderer::SpeedTerm term) {
      the_case_->proxy->display().change([=](engine::DisplaySettings& s) { s.speed_term = term; });
    };
    show_term(renderer::SpeedTerm::doubt);
    QVERIFY(choice->isVisible());
    const auto back = qScopeGuard([&] { show_term(renderer::SpeedTerm::data); });
    const auto parts = [&] {
      QList<QWidget*> seen = choice->findChildren<QWidget*>(QString(), Qt::FindDirectChildrenOnly);
      for (QWidget* part : bar.findChildren<QWidget*>(QString(), Qt::FindDirectChildrenOnly)) {
        if (part->isVisible() && part != choice && !qobject_cast<QLabel*>(part)) seen << part;
      }
      return seen;
    };
    const auto cut = [&] {
      QStringList names;
      for (const QWidget* part : parts()) {
        const auto* number = qobject_cast<const QDoubleSpinBox*>(part);
        if (part->width() < (number ? number->maximumWidth() : part->sizeHint().width()))
          names << part->accessibleName();
      }
      return names.join(", ");
    };
    const qsizetype all = parts().size();
    QVERIFY(box("Target T").isVisible());
    const QFont normal = QApplication::font();
    QFont font = normal;
    font.setPointSizeF(type * font.pointSizeF());
    QApplication::setFont(font);
    const auto back_to_normal = qScopeGuard([&] { QApplication::setFont(normal); });
    for (QWidget* part : bar.findChildren<QWidget*>()) part->setFont(font);
    for (const int width : {600, 400, 300, 240, 200, 160, 1}) {
      bar.resize(std::max(width, bar.minimumSizeHint().width()), 30);
      QTRY_COMPARE(cut(), QString());
      QVERIFY(choice->isVisible());
    }
    QVERIFY(parts().size() < all);
    bar.resize(1000, 30);
    QTRY_COMPARE(parts().size(), all);
  }

  void play_and_step_are_of_its_own_case() {
    the_case_->begin(5.0);
    the_case_->wait_until_idle();
    auto* play = test::named<QToolButton>(*bar_, "Play");
    auto* step = test::named<QToolButton>(*bar_, "Compute one step");
    QVERIFY(play && play->isEnabled() && step && step->isEnabled());
    step->click();
    the_case_->wait_until_idle();
    QCOMPARE(the_case_->state().step, 1);
    play->click();
    QTRY_VERIFY(the_case_->state().playing || the_case_->state().step > 1);
    the_case_->proxy->pause();
    the_case_->wait_until_idle();
    QCOMPARE(play->accessibleName(), "Play");
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

}  // namespace tidemark::test::view_bar_test

#include "view_bar_test.moc"
