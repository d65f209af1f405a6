// What holds for all panels.
#include <QAbstractButton>
#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QComboBox>
#include <QLineEdit>
#include <QScrollBar>
#include <QTableView>
#include <functional>

#include "tests/support/test_program.h"
#include "tests/ui/panels/panel_case.h"
#include "ui/panels/display_panel.h"
#include "ui/panels/history_panel.h"
#include "ui/panels/initialise_panel.h"
#include "ui/panels/labels_panel.h"
#include "ui/panels/level_set_panel.h"
#include "ui/panels/paint_panel.h"
#include "ui/panels/speed_plot.h"
#include "ui/panels/statistics_panel.h"
#include "ui/panels/sweep_panel.h"

namespace tidemark::test::every_panel_test {

using MakePanel = std::function<std::unique_ptr<ui::Panel>()>;

// Whether a widget is a part of another control.
static bool is_inner(const QWidget& widget) {
  for (const QWidget* outer = widget.parentWidget(); outer; outer = outer->parentWidget()) {
    if (qobject_cast<const QAbstractSpinBox*>(outer) || qobject_cast<const QComboBox*>(outer) ||
        qobject_cast<const QLineEdit*>(outer) || qobject_cast<const QTableView*>(outer)) {
      return true;
    }
  }
  return qobject_cast<const QScrollBar*>(&widget) != nullptr;
}

static QWidgetList controls(const QWidget& panel) {
  QWidgetList found;
  for (QWidget* widget : panel.findChildren<QWidget*>()) {
    const bool is_control = qobject_cast<QAbstractButton*>(widget) ||
                            qobject_cast<QAbstractSlider*>(widget) ||
                            qobject_cast<QAbstractSpinBox*>(widget) || qobject_cast<QComboBox*>(widget) ||
                            qobject_cast<QLineEdit*>(widget) || qobject_cast<ui::SpeedPlot*>(widget);
    // A button without an action is not shown.
    const bool waits =
        widget->isHidden() && widget->toolTip().isEmpty() && qobject_cast<QAbstractButton*>(widget);
    if (is_control && !is_inner(*widget) && !waits) found << widget;
  }
  return found;
}

static QString describe(const QWidget& widget) {
  const auto* button = qobject_cast<const QAbstractButton*>(&widget);
  return QStringLiteral("%1 “%2”").arg(QLatin1String(widget.metaObject()->className()),
                                       button ? button->text() : widget.accessibleName());
}

class EveryPanelTest : public QObject {
  Q_OBJECT
 private slots:
  void every_control_has_a_name_a_tip_and_a_way_by_keyboard_data() { panels(); }
  void every_control_has_a_name_a_tip_and_a_way_by_keyboard() {
    const auto panel = made();
    QVERIFY(!controls(*panel).isEmpty());
    for (const QWidget* control : controls(*panel)) {
      const auto* button = qobject_cast<const QAbstractButton*>(control);
      QVERIFY2(!control->accessibleName().isEmpty() || (button && !button->text().isEmpty()),
               qPrintable(describe(*control)));
      QVERIFY2(!control->toolTip().isEmpty(), qPrintable(describe(*control)));
      QVERIFY2(control->focusPolicy() & Qt::TabFocus, qPrintable(describe(*control)));
    }
  }

  void a_panel_fits_into_280_pixels_with_a_scroll_bar_data() { panels(); }
  void a_panel_fits_into_280_pixels_with_a_scroll_bar() {
    the_case_.begin();
    const auto panel = made();
    panel->set_proxy(the_case_.proxy.get());
    show(*panel);
    QVERIFY2(panel->minimumSizeHint().width() <= 280 - 14,
             qPrintable(QString::number(panel->minimumSizeHint().width())));
  }

  void a_panel_may_have_no_session_lose_it_and_get_another_data() { panels(); }
  void a_panel_may_have_no_session_lose_it_and_get_another() {
    const auto panel = made();
    show(*panel);
    const auto enabled = [&] { return controls(*panel).first()->isEnabledTo(panel.get()); };
    panel->set_proxy(nullptr);
    QVERIFY(!enabled());
    auto short_lived = std::make_unique<PanelCase>();
    panel->set_proxy(short_lived->proxy.get());
    short_lived->begin();
    panel->set_proxy(the_case_.proxy.get());
    short_lived.reset();
    QVERIFY(panel->proxy() == the_case_.proxy.get());
    panel->set_proxy(nullptr);
    QVERIFY(!enabled());
  }

 private:
  static void panels() {
    QTest::addColumn<MakePanel>("make");
    const auto add = [](const char* name, const MakePanel& make) { QTest::newRow(name) << make; };
    add("level set", [] { return std::make_unique<ui::LevelSetPanel>(); });
    add("start", [] { return std::make_unique<ui::InitialisePanel>(); });
    add("paint", [] { return std::make_unique<ui::PaintPanel>(); });
    add("display", [] { return std::make_unique<ui::DisplayPanel>(); });
    add("history", [] { return std::make_unique<ui::HistoryPanel>(); });
    add("labels", [] { return std::make_unique<ui::LabelsPanel>(); });
    add("statistics", [] { return std::make_unique<ui::StatisticsPanel>(); });
    add("sweep", [] { return std::make_unique<ui::SweepPanel>(); });
  }
  static std::unique_ptr<ui::Panel> made() {
    QFETCH(MakePanel, make);
    return make();
  }

  PanelCase the_case_;
};

TIDEMARK_TEST(EveryPanelTest)

}  // namespace tidemark::test::every_panel_test

#include "every_panel_test.moc"
