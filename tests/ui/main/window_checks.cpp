#include "tests/ui/main/window_checks.h"

#include <QDialogButtonBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QKeySequence>
#include <QLabel>
#include <QMap>
#include <QMenu>
#include <QMenuBar>
#include <QRegularExpression>
#include <QScrollArea>

#include "ui/main/panel_docks.h"
#include "ui/views/view_bar.h"

namespace tidemark::test {
namespace {

void look_for_doubles(const QString& name, const QWidget& menu, QStringList& doubles) {
  static const QRegularExpression kLetter("(?<!&)&([^&\\s])");
  QMap<QChar, QString> taken;
  for (QAction* action : menu.actions()) {
    const QString text = action->text();
    if (action->menu()) look_for_doubles(text, *action->menu(), doubles);
    const auto match = kLetter.match(text);
    if (!match.hasMatch()) continue;
    const QChar letter = match.captured(1).front().toLower();
    if (taken.contains(letter)) doubles << name + ": " + taken[letter] + ", " + text;
    taken[letter] = text;
  }
}

}  // namespace

QStringList doubled_menu_letters(ui::MainWindow& window) {
  QStringList doubles;
  look_for_doubles("menu bar", *window.menuBar(), doubles);
  return doubles;
}

QStringList doubled_letters(const QWidget& dialog) {
  QStringList doubles;
  QMap<QString, QString> taken;
  const auto look_at = [&](const QString& text) {
    const QString key = QKeySequence::mnemonic(text).toString();
    if (key.isEmpty()) return;
    if (taken.contains(key)) doubles << taken[key] + ", " + text;
    taken[key] = text;
  };
  for (const QLabel* label : dialog.findChildren<QLabel*>()) {
    if (label->isVisible() && label->buddy()) look_at(label->text());
  }
  for (QAbstractButton* button : dialog.findChildren<QAbstractButton*>()) {
    const auto* box = qobject_cast<QDialogButtonBox*>(button->parentWidget());
    const bool is_of_qt = box && box->standardButton(button) != QDialogButtonBox::NoButton;
    if (button->isVisible() && !is_of_qt) look_at(button->text());
  }
  return doubles;
}

QStringList cut_bars(ui::MainWindow& window) {
  QStringList cut;
  int bars = 0;
  for (const ui::ViewBar* bar : window.active_case()->findChildren<ui::ViewBar*>()) {
    if (!bar->isVisible()) continue;
    ++bars;
    if (bar->height() < bar->sizeHint().height()) cut << "a bar is too low";
    for (const QWidget* part : bar->findChildren<QWidget*>(QString(), Qt::FindDirectChildrenOnly)) {
      if (!part->isVisible() || qobject_cast<const QMenu*>(part)) continue;
      const QSize wanted = part->sizeHint();
      const auto* number = qobject_cast<const QDoubleSpinBox*>(part);
      const int width = number ? number->fontMetrics().horizontalAdvance(number->text()) + 8 : wanted.width();
      if (part->width() >= width && part->height() >= std::min(wanted.height(), bar->height() - 2)) continue;
      cut << QString("%1 \"%2\": %3 x %4, wants %5 x %6")
                 .arg(part->metaObject()->className(), part->accessibleName())
                 .arg(part->width())
                 .arg(part->height())
                 .arg(width)
                 .arg(wanted.height());
    }
  }
  if (bars == 0) cut << "there are no bars";
  return cut;
}

QStringList panels_too_wide(Desktop& desktop, const QString& suffix) {
  constexpr int kColumn = 320;
  QStringList wide;
  for (const char* name : {"initialise", "level-set", "history", "paint", "display", "transfer", "labels",
                           "statistics", "sweep"}) {
    desktop.window().panels().show(name);
    QTest::qWait(50);
    auto* dock = desktop.window().findChild<QDockWidget*>(name);
    if (!dock || !dock->isVisible()) {
      wide << QString("%1 is not shown").arg(name);
      continue;
    }
    if (dock->width() != kColumn) wide << QString("%1 is %2 wide").arg(name).arg(dock->width());
    for (const QScrollArea* area : dock->findChildren<QScrollArea*>()) {
      if (!area->isVisible()) continue;
      const auto fits = [area] { return area->widget()->width() <= area->viewport()->width(); };
      if (!Desktop::wait_for(fits, 2000))
        wide << QString("%1: %2 in %3").arg(name).arg(area->widget()->width()).arg(area->viewport()->width());
    }
    desktop.screenshot(QStringLiteral("panel-%1-%2").arg(name, suffix));
  }
  return wide;
}

}  // namespace tidemark::test
