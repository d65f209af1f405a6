// Whose case the panels act on while two are open: only what is done to a case's window changes it.
#include <QApplication>
#include <QComboBox>
#include <QDialog>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QMdiArea>
#include <QMdiSubWindow>
#include <QTabBar>
#include <QTableView>
#include <QToolButton>
#include <algorithm>

#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "ui/main/panel_docks.h"
#include "ui/panels/labels_panel.h"
#include "ui/panels/speed_controls.h"

namespace tidemark::test::active_case_test {

class ActiveCaseTest : public QObject {
  Q_OBJECT

 private slots:
  void init();
  void cleanup() { desktop_.reset(); }
  void a_click_on_any_tab_of_the_panels_keeps_the_case_data() { orders(); }
  void a_click_on_any_tab_of_the_panels_keeps_the_case();
  void tab_and_backtab_through_all_panels_keep_the_case_data() { orders(); }
  void tab_and_backtab_through_all_panels_keep_the_case();
  void a_label_goes_to_the_case_whose_panel_was_used();
  void a_panel_that_is_closed_keeps_the_case();
  void a_control_that_becomes_grey_keeps_the_case();
  void hiding_all_panels_keeps_the_case();
  void popups_and_dialogs_of_panels_keep_the_case();
  void keys_of_panels_keep_the_case();
  void what_is_done_to_a_case_window_changes_the_case();
  void a_case_that_closes_hands_over_to_the_other();
  void a_view_in_a_window_of_its_own_brings_its_case_along();
  void the_press_that_activates_a_case_changes_nothing_in_it();

 private:
  // Which case is active, how windows stand.
  static void orders();
  void begin_with(int active, bool tabs);
  void click_view(int of);
  void click(QWidget& widget, QPoint at);
  void click(QWidget& widget) { click(widget, widget.rect().center()); }
  // The panel to the front by a click on its tab; its dock.
  QDockWidget* choose(const QString& title);
  QDoubleSpinBox* number(const QString& name);
  [[nodiscard]] QStringList titles() const;
  [[nodiscard]] QTabBar* tab_bar() const;
  [[nodiscard]] ui::CaseWindow* active() const { return desktop_->window().active_case(); }

  std::unique_ptr<Desktop> desktop_;
  QList<ui::CaseWindow*> cases_;
};

void ActiveCaseTest::init() {
  desktop_ = std::make_unique<Desktop>(solver::ExecutorKind::host, QSize(1200, 760));
  cases_ = {desktop_->open_phantom("sphere"), desktop_->open_phantom("dumbbell")};
  desktop_->window().actions().tile->trigger();
  for (ui::CaseWindow* window : cases_) {
    const auto& seed = *window->proxy().study().start->seed;
    document::Start start;
    start.seeds.push_back({window->proxy().volume().geometry.to_patient({seed[0], seed[1], seed[2]}), 8.0});
    window->proxy().begin(start);
  }
  // The one panel that is not there from the beginning.
  desktop_->window().panels().show("passes");
  desktop_->wait_until_idle();
}

void ActiveCaseTest::orders() {
  QTest::addColumn<int>("which");
  QTest::addColumn<bool>("tabs");
  QTest::newRow("the first, tiled") << 0 << false;
  QTest::newRow("the second, tiled") << 1 << false;
  QTest::newRow("the first, in tabs") << 0 << true;
}

void ActiveCaseTest::begin_with(int which, bool tabs) {
  desktop_->window().actions().tabs->setChecked(tabs);
  auto* area = desktop_->window().findChild<QMdiArea*>();
  if (tabs) {
    auto* bar = area->findChild<QTabBar*>();
    click(*bar, bar->tabRect(which).center());
  }
  click_view(which);
  QCOMPARE(active(), cases_[which]);
}

void ActiveCaseTest::click_view(int of) {
  ui::PictureView* view = cases_[of]->views().first();
  QVERIFY(view->isVisible());
  click(*view);
}

void ActiveCaseTest::click(QWidget& widget, QPoint at) {
  QTest::mouseClick(&widget, Qt::LeftButton, {}, at);
  QTest::qWait(5);  // panels come to the front in turns of the event loop of their own
}

QTabBar* ActiveCaseTest::tab_bar() const {
  const QStringList wanted = titles();
  for (auto* bar : desktop_->window().findChildren<QTabBar*>(QString(), Qt::FindDirectChildrenOnly)) {
    if (bar->isVisible() && bar->count() > 1 && wanted.contains(bar->tabText(0))) return bar;
  }
  return nullptr;
}

QStringList ActiveCaseTest::titles() const {
  QStringList titles;
  for (const QAction* toggle : desktop_->window().panels().toggles()) titles << toggle->text();
  return titles;
}

QDockWidget* ActiveCaseTest::choose(const QString& title) {
  QTabBar* bar = tab_bar();
  for (int tab = 0; bar && tab < bar->count(); ++tab) {
    if (bar->tabText(tab) == title) click(*bar, bar->tabRect(tab).center());
  }
  for (auto* dock : desktop_->window().findChildren<QDockWidget*>()) {
    if (dock->windowTitle() == title && !dock->visibleRegion().isEmpty()) return dock;
  }
  return nullptr;
}

QDoubleSpinBox* ActiveCaseTest::number(const QString& name) {
  for (auto* number : desktop_->window().findChildren<QDoubleSpinBox*>()) {
    if (number->accessibleName() == name) return number;
  }
  return nullptr;
}

void ActiveCaseTest::a_click_on_any_tab_of_the_panels_keeps_the_case() {
  QFETCH(int, which);
  QFETCH(bool, tabs);
  begin_with(which, tabs);
  for (const QString& from : titles()) {
    for (const QString& to : titles()) {
      QDockWidget* dock = choose(from);
      QVERIFY2(dock, qPrintable(from));
      // The keyboard in some control of it, by a click where that does nothing else.
      for (auto* inside : dock->findChildren<QWidget*>()) {
        if (!inside->isVisible() || !inside->isEnabled() || !(inside->focusPolicy() & Qt::TabFocus)) continue;
        inside->setFocus(Qt::MouseFocusReason);
        break;
      }
      QVERIFY2(choose(to), qPrintable(to));
      QVERIFY2(active() == cases_[which], qPrintable(from + " to " + to));
    }
  }
}

void ActiveCaseTest::tab_and_backtab_through_all_panels_keep_the_case() {
  QFETCH(int, which);
  QFETCH(bool, tabs);
  begin_with(which, tabs);
  constexpr int kPresses = 60;  // more than any panel has controls
  for (const QString& title : titles()) {
    QVERIFY2(choose(title), qPrintable(title));
    for (const Qt::Key key : {Qt::Key_Tab, Qt::Key_Backtab}) {
      QVERIFY(choose(title));
      QDockWidget* dock = choose(title);
      for (auto* inside : dock->findChildren<QWidget*>()) {
        if (inside->isVisible() && inside->isEnabled() && (inside->focusPolicy() & Qt::TabFocus)) {
          inside->setFocus(Qt::TabFocusReason);
          break;
        }
      }
      for (int press = 0; press < kPresses; ++press) {
        QWidget* before = QApplication::focusWidget();
        QVERIFY(before);
        QTest::keyClick(before, key, key == Qt::Key_Backtab ? Qt::ShiftModifier : Qt::NoModifier);
        QVERIFY2(
            active() == cases_[which],
            qPrintable(
                QStringLiteral("%1: %2 after %3").arg(title, before->metaObject()->className()).arg(press)));
      }
    }
  }
}

void ActiveCaseTest::a_label_goes_to_the_case_whose_panel_was_used() {
  for (const int which : {0, 1}) {
    begin_with(which, false);
    choose("Level set");
    QDoubleSpinBox* target = number("Target T");
    QVERIFY(target && target->isVisible());
    click(*target);
    QVERIFY(target->hasFocus());
    choose("Labels");
    QToolButton* add = nullptr;
    for (auto* button : desktop_->window().findChild<ui::LabelsPanel*>()->findChildren<QToolButton*>()) {
      if (button->text() == "Add") add = button;
    }
    QVERIFY(add && add->isVisible());
    const auto labels = [&](int of) { return cases_[of]->proxy().state().labels.size(); };
    const std::size_t mine = labels(which);
    const std::size_t others = labels(1 - which);
    click(*add);
    desktop_->wait_until_idle();
    QCOMPARE(labels(which), mine + 1);
    QCOMPARE(labels(1 - which), others);
  }
}

void ActiveCaseTest::a_panel_that_is_closed_keeps_the_case() {
  begin_with(0, false);
  QDockWidget* dock = choose("Level set");
  click(*number("Target T"));
  dock->close();
  desktop_->wait_until_idle();
  QCOMPARE(active(), cases_[0]);
  // The last one, too, after which only views can have the keyboard.
  for (const QString& title : titles()) {
    for (auto* other : desktop_->window().findChildren<QDockWidget*>()) {
      if (other->windowTitle() != title || !other->isVisible()) continue;
      for (auto* inside : other->findChildren<QWidget*>()) {
        if (inside->isVisible() && (inside->focusPolicy() & Qt::TabFocus)) inside->setFocus();
      }
      other->close();
      desktop_->wait_until_idle();
      QVERIFY2(active() == cases_[0], qPrintable(title));
    }
  }
  QVERIFY(!QApplication::focusWidget() || !cases_[1]->isAncestorOf(QApplication::focusWidget()));
}

void ActiveCaseTest::a_control_that_becomes_grey_keeps_the_case() {
  begin_with(0, false);
  choose("Level set");
  QDoubleSpinBox* target = number("Target T");
  click(*target);
  QVERIFY(target->hasFocus());
  target->setEnabled(false);
  desktop_->wait_until_idle();
  QCOMPARE(active(), cases_[0]);
  target->setEnabled(true);
}

void ActiveCaseTest::hiding_all_panels_keeps_the_case() {
  begin_with(0, false);
  choose("Level set");
  click(*number("Target T"));
  desktop_->press(Qt::Key_F3);
  desktop_->wait_until_idle();
  QCOMPARE(active(), cases_[0]);
  desktop_->press(Qt::Key_F3);
  desktop_->wait_until_idle();
  QCOMPARE(active(), cases_[0]);
}

void ActiveCaseTest::popups_and_dialogs_of_panels_keep_the_case() {
  begin_with(0, false);
  // A list that opens, and closes by Escape and by a choice.
  QDockWidget* display = choose("Display");
  QVERIFY(display);
  QComboBox* box = nullptr;
  for (auto* candidate : display->findChildren<QComboBox*>()) {
    if (!box && candidate->isVisible() && candidate->isEnabled()) box = candidate;
  }
  QVERIFY(box);
  for (const Qt::Key end : {Qt::Key_Escape, Qt::Key_Return}) {
    box->setFocus(Qt::MouseFocusReason);
    box->showPopup();
    desktop_->wait_until_idle();
    QVERIFY(box->view()->isVisible());
    QTest::keyClick(box->view(), end);
    desktop_->wait_until_idle();
    QVERIFY(!box->view()->isVisible());
    QCOMPARE(active(), cases_[0]);
  }
  // A dialog that a panel opens, without and with the other panel in front when it closes.
  QVERIFY(choose("Labels"));
  auto* table = desktop_->window().findChild<ui::LabelsPanel*>()->findChild<QTableView*>();
  cases_[0]->proxy().add_label("A");
  desktop_->wait_until_idle();
  constexpr int kColour = 2;
  for (int turn = 0; turn < 2; ++turn) {
    QTest::mouseClick(table->viewport(), Qt::LeftButton, {},
                      table->visualRect(table->model()->index(0, kColour)).center());
    QDialog* dialog = nullptr;
    QVERIFY(Desktop::wait_for([&] {
      for (auto* open : desktop_->window().findChildren<QDialog*>()) {
        if (open->isVisible()) dialog = open;
      }
      return dialog != nullptr;
    }));
    QVERIFY(QTest::qWaitForWindowActive(dialog));
    QCOMPARE(active(), cases_[0]);
    if (turn == 1) desktop_->window().panels().show("paint");
    QTest::keyClick(dialog, Qt::Key_Escape);
    QVERIFY(QTest::qWaitForWindowActive(&desktop_->window()));
    desktop_->wait_until_idle();
    QCOMPARE(active(), cases_[0]);
  }
}

void ActiveCaseTest::keys_of_panels_keep_the_case() {
  begin_with(0, false);
  for (const QString& title : titles()) {
    QDockWidget* dock = choose(title);
    QVERIFY(dock);
    for (auto* inside : dock->findChildren<QWidget*>()) {
      if (!inside->isVisible() || !inside->isEnabled() || !(inside->focusPolicy() & Qt::TabFocus)) continue;
      inside->setFocus(Qt::TabFocusReason);
      for (const Qt::Key key : {Qt::Key_Up, Qt::Key_Down, Qt::Key_Return, Qt::Key_Escape}) {
        QTest::keyClick(inside, key);
        QCOMPARE(active(), cases_[0]);
        // What a key opened is not the matter here.
        if (QWidget* popup = QApplication::activePopupWidget()) popup->close();
        if (QWidget* dialog = QApplication::activeModalWidget()) dialog->close();
      }
      if (!inside->isVisible()) break;
    }
    desktop_->wait_until_idle();
    QCOMPARE(active(), cases_[0]);
  }
}

void ActiveCaseTest::what_is_done_to_a_case_window_changes_the_case() {
  begin_with(0, false);
  choose("Level set");
  click(*number("Target T"));
  click_view(1);
  QCOMPARE(active(), cases_[1]);
  // Its title.
  auto* child = qobject_cast<QMdiSubWindow*>(cases_[0]->parentWidget());
  QVERIFY(child);
  QTest::mouseClick(child, Qt::LeftButton, {}, QPoint(child->width() / 2, 8));
  desktop_->wait_until_idle();
  QCOMPARE(active(), cases_[0]);
  // Qt's key for the next window.
  QTest::keyClick(cases_[0]->views().first(), Qt::Key_Tab, Qt::ControlModifier);
  QTest::keyRelease(cases_[0]->views().first(), Qt::Key_Control);
  desktop_->wait_until_idle();
  QCOMPARE(active(), cases_[1]);
  // Tabs.
  desktop_->window().actions().tabs->setChecked(true);
  choose("Level set");
  click(*number("Target T"));
  auto* bar = desktop_->window().findChild<QMdiArea*>()->findChild<QTabBar*>();
  for (const int which : {0, 1, 0}) {
    click(*bar, bar->tabRect(which).center());
    QCOMPARE(active(), cases_[which]);
  }
}

void ActiveCaseTest::a_view_in_a_window_of_its_own_brings_its_case_along() {
  begin_with(0, false);
  ui::PictureView* view = cases_[0]->views().last();
  QDockWidget* dock = cases_[0]->dock_of(view);
  dock->setFloating(true);
  QVERIFY(QTest::qWaitForWindowExposed(dock));
  for (int turn = 0; turn < 2; ++turn) {
    desktop_->window().activateWindow();
    QVERIFY(QTest::qWaitForWindowActive(&desktop_->window()));
    click_view(1);
    QCOMPARE(active(), cases_[1]);
    dock->activateWindow();
    QVERIFY(Desktop::wait_for([&] { return QApplication::activeWindow() == dock; }));
    QTest::mouseClick(view, Qt::MiddleButton, {}, view->rect().center());
    QVERIFY(Desktop::wait_for([&] { return active() == cases_[0]; }));
    QCOMPARE(QApplication::focusWidget(), view);
    const std::int64_t before = cases_[0]->proxy().state().step;
    const std::int64_t of_other = cases_[1]->proxy().state().step;
    QTest::keyClick(view, Qt::Key_Period);
    desktop_->wait_until_idle();
    QCOMPARE(cases_[0]->proxy().state().step, before + 1);
    QCOMPARE(cases_[1]->proxy().state().step, of_other);
  }
}

void ActiveCaseTest::the_press_that_activates_a_case_changes_nothing_in_it() {
  // Of the surface and of labels.
  const auto voxels = [&] {
    const engine::CaseState& state = cases_[1]->proxy().state();
    std::int64_t count = state.surface.voxels_inside;
    for (const auto& label : state.label_statistics) count += label.voxels;
    return count;
  };
  int above = -20;  // pixels, where nothing was placed before
  for (const engine::Tool tool : {engine::Tool::seed, engine::Tool::label, engine::Tool::paint}) {
    begin_with(0, false);
    cases_[1]->proxy().display().choose_tool(tool);
    desktop_->wait_until_idle();
    const std::int64_t before = voxels();
    ui::PictureView& view = *cases_[1]->views().first();
    const QPoint beside = view.rect().center() + QPoint(view.width() / 5, above += 10);
    click(view, beside);
    desktop_->wait_until_idle();
    QCOMPARE(active(), cases_[1]);
    QCOMPARE(voxels(), before);
    click(view, beside);
    desktop_->wait_until_idle();
    QVERIFY(voxels() > before);
    cases_[1]->proxy().display().choose_tool(engine::Tool::crosshair);
  }
}

void ActiveCaseTest::a_case_that_closes_hands_over_to_the_other() {
  begin_with(0, false);
  choose("Level set");
  click(*number("Target T"));
  const QPointer<ui::CaseWindow> closed = cases_[0];
  closed->close_saved();
  QVERIFY(Desktop::wait_for([&] { return closed.isNull(); }));
  desktop_->wait_until_idle();
  QCOMPARE(active(), cases_[1]);
  QVERIFY(number("Target T")->isVisible());
  // One that is not active closes without changing anything.
  ui::CaseWindow* third = desktop_->open_phantom("sphere");
  desktop_->window().actions().tile->trigger();
  desktop_->wait_until_idle();
  QCOMPARE(active(), third);
  choose("Level set");
  click(*number("Target T"));
  cases_[1]->close_saved();
  QVERIFY(Desktop::wait_for([&] { return desktop_->window().cases().size() == 1; }));
  desktop_->wait_until_idle();
  QCOMPARE(active(), third);
}

TIDEMARK_TEST(ActiveCaseTest)

}  // namespace tidemark::test::active_case_test

#include "active_case_test.moc"
