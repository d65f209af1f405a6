// A case beside a copy of it: the scheme of the paper and the split one, in lock-step.
#include <QLabel>
#include <QMdiSubWindow>

#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "ui/main/case_head.h"
#include "ui/main/parameter_difference.h"

namespace tidemark::test::comparison_story_test {
namespace {

std::vector<float> phi_of(ui::CaseWindow& window) {
  return window.proxy().state().phi->dense();
}

// What the case's head says in its window.
QString head_of(ui::CaseWindow& window) {
  QString text;
  for (const QLabel* label : window.findChild<ui::CaseHead*>()->findChildren<QLabel*>()) {
    if (label->isVisible()) text += label->text() + ' ';
  }
  return text;
}

}  // namespace

class ComparisonStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void schemes_are_compared_by_one_click();
  void a_duplicate_goes_on_by_itself();
  void parameters_that_differ_are_named();
};

void ComparisonStoryTest::schemes_are_compared_by_one_click() {
  const Variable renderer("TIDEMARK_RENDERER", renderer_beside(story_executor()));
  Desktop desktop(story_executor(), {1366, 768});
  ui::CaseWindow* original = desktop.open_phantom("dumbbell");
  QVERIFY(original);
  QVERIFY(!desktop.window().actions().compare_schemes->isEnabled());
  desktop.begin(8.0);
  desktop.proxy().set_pause_at_convergence(false);
  desktop.proxy().step(6);
  QVERIFY(Desktop::wait_for([&] { return desktop.state().step == 6; }));
  desktop.wait_until_idle();
  const QString executor = desktop.state().executor;
  desktop.choose("Window", desktop.window().actions().compare_schemes);
  QVERIFY(Desktop::wait_for([&] { return desktop.window().cases().size() == 2; }));
  ui::CaseWindow* copy = desktop.window().cases()[1];
  const auto both_at = [&](std::int64_t step) {
    return original->proxy().state().step >= step && copy->proxy().state().step >= step;
  };
  QVERIFY(Desktop::wait_for([&] { return both_at(30); }, 60000));
  QVERIFY(original->proxy().in_lock_step() && copy->proxy().in_lock_step());
  QVERIFY(desktop.window().actions().lock_step->isChecked());
  QVERIFY(original->linked() && copy->linked());
  QCOMPARE(copy->proxy().state().executor, executor);
  QCOMPARE(original->proxy().parameters().scheme, solver::Scheme::split);
  QCOMPARE(copy->proxy().parameters().scheme, solver::Scheme::paper);
  // Each says which it is.
  QVERIFY2(head_of(*original).contains("Split scheme"), qPrintable(head_of(*original)));
  QVERIFY2(head_of(*copy).contains("Paper scheme"), qPrintable(head_of(*copy)));
  // Side by side.
  const auto* left = qobject_cast<QMdiSubWindow*>(original->parentWidget());
  const auto* right = qobject_cast<QMdiSubWindow*>(copy->parentWidget());
  QVERIFY(!left->geometry().intersects(right->geometry()));
  desktop.press(Qt::Key_P);
  QVERIFY(Desktop::wait_for(
      [&] { return !original->proxy().state().playing && !copy->proxy().state().playing; }));
  desktop.wait_until_idle();
  QCOMPARE(original->proxy().state().step, copy->proxy().state().step);
  QVERIFY(phi_of(*original) != phi_of(*copy));
  desktop.screenshot("comparison");
  // Both undo: they are at the state where they were one.
  for (ui::CaseWindow* window : {original, copy}) {
    while (window->proxy().state().step > 6 || window->proxy().parameters().scheme == solver::Scheme::paper) {
      window->proxy().undo();
      desktop.wait_until_idle();
    }
  }
  QVERIFY(phi_of(*original) == phi_of(*copy));
  QVERIFY(head_of(*copy).contains("scheme") == false);
  // The one that stays is free.
  copy->close_saved();
  QVERIFY(Desktop::wait_for([&] { return desktop.window().cases().size() == 1; }));
  QVERIFY(Desktop::wait_for([&] { return !desktop.window().actions().lock_step->isChecked(); }));
  QVERIFY(Desktop::wait_for([&] { return !original->linked(); }));
  QVERIFY(original->difference().isEmpty());
}

void ComparisonStoryTest::a_duplicate_goes_on_by_itself() {
  Desktop desktop(story_executor(), {1366, 768});
  ui::CaseWindow* original = desktop.open_phantom("sphere");
  desktop.begin(8.0);
  desktop.proxy().step(4);
  QVERIFY(Desktop::wait_for([&] { return desktop.state().step == 4; }));
  desktop.wait_until_idle();
  desktop.choose("Window", desktop.window().actions().duplicate_case);
  QVERIFY(Desktop::wait_for([&] { return desktop.window().cases().size() == 2; }));
  desktop.wait_until_idle();
  ui::CaseWindow* copy = desktop.window().cases()[1];
  QCOMPARE(copy->proxy().state().step, std::int64_t{4});
  QVERIFY(phi_of(*original) == phi_of(*copy));
  QVERIFY(copy->session_file.isEmpty());
  QVERIFY(copy->proxy().state().modified);  // it is in no file, so that closing it asks
  copy->proxy().step(3);
  QVERIFY(Desktop::wait_for([&] { return copy->proxy().state().step == 7; }));
  desktop.wait_until_idle();
  QCOMPARE(original->proxy().state().step, std::int64_t{4});
  original->proxy().step(3);
  desktop.wait_until_idle();
  QVERIFY(phi_of(*original) == phi_of(*copy));
  QCOMPARE(copy->proxy().state().undo_text, original->proxy().state().undo_text);
}

void ComparisonStoryTest::parameters_that_differ_are_named() {
  solver::Parameters one;
  solver::Parameters other = one;
  QCOMPARE(ui::parameter_differences({one, other}), QStringList({"", ""}));
  other.alpha = 0.25;
  other.band = 4.0;
  other.curvature_term = false;
  QCOMPARE(ui::parameter_differences({one, other}),
           QStringList({QStringLiteral("α 0.5, W by spacing, with curvature"),
                        QStringLiteral("α 0.25, W 4, without curvature")}));
}

TIDEMARK_TEST(ComparisonStoryTest)

}  // namespace tidemark::test::comparison_story_test

#include "comparison_story_test.moc"
