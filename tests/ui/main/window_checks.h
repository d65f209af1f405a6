// Checks of the whole window, for any language and any scale. Each answers with what is wrong.
#pragma once

#include <QStringList>

#include "tests/ui/main/desktop.h"

namespace tidemark::test {

// Menus with a letter that two entries have.
QStringList doubled_menu_letters(ui::MainWindow& window);
// Labels and buttons of a dialog that have one letter. Qt's own buttons do not count.
QStringList doubled_letters(const QWidget& dialog);
// Parts of the bars over the active case's views that have less room than they want.
QStringList cut_bars(ui::MainWindow& window);
// Panels that are wider than their column of 320 pixels. Shows one after the other, with a screenshot called
// "panel-NAME-SUFFIX".
QStringList panels_too_wide(Desktop& desktop, const QString& suffix);

}  // namespace tidemark::test
