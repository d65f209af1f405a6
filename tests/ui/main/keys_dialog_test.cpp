// Keys, changed without a mouse.
#include "ui/main/keys_dialog.h"

#include <QDialogButtonBox>
#include <QKeySequenceEdit>
#include <QPushButton>
#include <QSettings>
#include <QTableWidget>
#include <algorithm>

#include "tests/support/test_program.h"
#include "tests/ui/panels/panel_case.h"

namespace tidemark::test::keys_dialog_test {

class KeysDialogTest : public QObject {
  Q_OBJECT

  std::unique_ptr<TemporaryFolder> folder_;
  std::unique_ptr<ui::Actions> actions_;
  std::unique_ptr<ui::KeysDialog> dialog_;

  QKeySequenceEdit& box(const QAction* action) {
    const auto& all = actions_->all();
    const auto row = std::find(all.begin(), all.end(), action) - all.begin();
    auto* table = dialog_->findChild<QTableWidget*>();
    return *qobject_cast<QKeySequenceEdit*>(table->cellWidget(static_cast<int>(row), 1));
  }
  QPushButton* standard(QDialogButtonBox::StandardButton which) {
    return dialog_->findChild<QDialogButtonBox*>()->button(which);
  }
  void press(Qt::Key key, Qt::KeyboardModifiers modifiers = {}) {
    QTest::keyClick(dialog_->focusWidget(), key, modifiers);
  }
  // As after the program was started again.
  QKeySequence kept(QAction* ui::Actions::*action) { return (ui::Actions(nullptr).*action)->shortcut(); }

 private slots:
  void init() {
    folder_ = std::make_unique<TemporaryFolder>();
    QSettings::setDefaultFormat(QSettings::IniFormat);
    QSettings::setPath(QSettings::IniFormat, QSettings::UserScope,
                       QString::fromStdString(folder_->path().string()));
    actions_ = std::make_unique<ui::Actions>(nullptr);
    dialog_ = std::make_unique<ui::KeysDialog>(*actions_);
    show(*dialog_);
  }
  void cleanup() {
    dialog_.reset();
    actions_.reset();
  }

  void tab_goes_through_the_boxes_to_the_buttons() {
    const auto reach = [&](const QWidget* wanted) {
      dialog_->findChild<QTableWidget*>()->setFocus();
      for (std::size_t tab = 0; tab < actions_->all().size() + 5; ++tab) {
        if (dialog_->focusWidget() == wanted) return true;
        press(Qt::Key_Tab);
      }
      return false;
    };
    const QKeySequenceEdit& last = box(actions_->all().back());
    QVERIFY(reach(&last));
    QVERIFY(!last.visibleRegion().isEmpty());
    QVERIFY(reach(standard(QDialogButtonBox::RestoreDefaults)));
    QVERIFY(reach(standard(QDialogButtonBox::Close)));
  }

  void escape_and_return_close_the_dialog_and_are_no_keys_data() {
    QTest::addColumn<Qt::Key>("key");
    QTest::newRow("Escape") << Qt::Key_Escape;
    QTest::newRow("Return") << Qt::Key_Return;
  }
  void escape_and_return_close_the_dialog_and_are_no_keys() {
    QFETCH(Qt::Key, key);
    box(actions_->open_folder).setFocus();
    press(key);
    QVERIFY(!dialog_->isVisible());
    QCOMPARE(actions_->open_folder->shortcut(), QKeySequence("Ctrl+O"));
    QCOMPARE(kept(&ui::Actions::open_folder), QKeySequence("Ctrl+O"));
  }

  void what_is_typed_is_the_key_also_where_the_dialog_closes_at_once() {
    box(actions_->play).setFocus();
    press(Qt::Key_F7);
    QTRY_COMPARE(actions_->play->shortcut(), QKeySequence("F7"));
    QCOMPARE(kept(&ui::Actions::play), QKeySequence("F7"));
    press(Qt::Key_F8, Qt::ControlModifier);
    press(Qt::Key_Escape);
    QCOMPARE(actions_->play->shortcut(), QKeySequence("Ctrl+F8"));
  }

  // Who speaks to the computer has no use for keys of one letter.
  void backspace_leaves_an_action_without_a_key() {
    box(actions_->play).setFocus();
    press(Qt::Key_Backspace);
    QCOMPARE(actions_->play->shortcut(), QKeySequence());
    QCOMPARE(kept(&ui::Actions::play), QKeySequence());
    QTest::mouseClick(standard(QDialogButtonBox::RestoreDefaults), Qt::LeftButton);
    QCOMPARE(actions_->play->shortcut(), QKeySequence("P"));
    QCOMPARE(box(actions_->play).keySequence(), QKeySequence("P"));
    QCOMPARE(kept(&ui::Actions::play), QKeySequence("P"));
  }
};

TIDEMARK_TEST(KeysDialogTest)

}  // namespace tidemark::test::keys_dialog_test

#include "keys_dialog_test.moc"
