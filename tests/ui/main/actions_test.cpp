// Actions, as the state of a case has them.
#include "ui/main/actions.h"

#include "tests/support/test_program.h"
#include "tests/ui/panels/panel_case.h"

namespace tidemark::test::actions_test {

class ActionsTest : public QObject {
  Q_OBJECT

 private slots:
  void a_name_stands_in_undo_and_redo_with_all_its_letters() {
    PanelCase the_case;
    the_case.begin();
    the_case.proxy->accept_surface(0, document::Take::free_voxels, "A&B");
    the_case.wait_until_idle();
    ui::Actions actions(nullptr);
    actions.follow(the_case.proxy.get());
    QCOMPARE(actions.undo->text(), QString("&Undo: accept into A&&B"));
    the_case.proxy->undo();
    the_case.wait_until_idle();
    actions.follow(the_case.proxy.get());
    QCOMPARE(actions.redo->text(), QString("&Redo: accept into A&&B"));
  }
};

TIDEMARK_TEST(ActionsTest)

}  // namespace tidemark::test::actions_test

#include "actions_test.moc"
