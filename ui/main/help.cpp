#include "ui/main/help.h"

#include <QApplication>
#include <QDesktopServices>
#include <QDockWidget>
#include <QFileInfo>
#include <QKeyEvent>
#include <QKeySequenceEdit>
#include <QUrl>

#include "ui/lessons/lesson_editor.h"
#include "ui/lessons/lesson_trial.h"
#include "ui/look/language.h"
#include "ui/main/keys_dialog.h"
#include "ui/main/main_window.h"
#include "ui/opening/series_browser.h"
#include "ui/pacs/query_dialog.h"
#include "ui/pacs/servers_dialog.h"
#include "ui/panels/registration_dialog.h"
#include "ui/readers/readers_dialog.h"
#include "ui/results/deidentify_dialog.h"
#include "ui/results/result_dialog.h"

namespace tidemark::ui {
namespace {

constexpr const char* kAboutHandbook = "handbook";

template <class... Dialogs>
bool is_one_of(const QWidget* widget) {
  return (qobject_cast<const Dialogs*>(widget) || ...);
}

// Of the panel or dialog around the widget, else the first one.
QString page_of(const QWidget* widget, const MainWindow& window) {
  for (; widget; widget = widget->parentWidget()) {
    // A panel's page has the name by which its arrangement is kept. Views are docks, too, of their case.
    if (qobject_cast<const QDockWidget*>(widget) && widget->parentWidget() == &window)
      return QStringLiteral("panels/") + widget->objectName();
    if (is_one_of<QueryDialog, ServersDialog>(widget)) return QStringLiteral("pacs");
    if (is_one_of<SeriesBrowser, RegistrationDialog>(widget)) return QStringLiteral("opening");
    if (is_one_of<ReadersDialog>(widget)) return QStringLiteral("measuring");
    if (is_one_of<ResultDialog>(widget)) return QStringLiteral("results");
    if (is_one_of<DeidentifyDialog>(widget)) return QStringLiteral("deidentify");
    if (is_one_of<LessonEditor, LessonTrial>(widget)) return QStringLiteral("lessons");
    if (is_one_of<KeysDialog>(widget)) return QStringLiteral("window");
    if (widget->isWindow()) break;
  }
  return QStringLiteral("first-page");
}

}  // namespace

Help::Help(MainWindow& window) : QObject(&window), window_(window) {
  const QString programs = QCoreApplication::applicationDirPath();
  folders_ = {programs + QStringLiteral("/../share/doc/tidemark/handbook"),
              programs + QStringLiteral("/../handbook/html")};
  connect(window.actions().handbook, &QAction::triggered, this, &Help::open);
  qApp->installEventFilter(this);
}

// Keys of actions belong to the main window, and other windows do not know them.
bool Help::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() != QEvent::KeyPress) return QObject::eventFilter(watched, event);
  const auto* key = static_cast<const QKeyEvent*>(event);
  const QWidget* active = QApplication::activeWindow();
  const bool elsewhere = active && active != &window_ && !qobject_cast<const QDockWidget*>(active) &&
                         !QApplication::activePopupWidget();
  const bool asks = QKeySequence(key->keyCombination()) == window_.actions().handbook->shortcut();
  // In the dialog of keys the press is what is entered.
  if (!elsewhere || !asks || qobject_cast<QKeySequenceEdit*>(QApplication::focusWidget())) {
    return QObject::eventFilter(watched, event);
  }
  if (!key->isAutoRepeat()) open();
  return true;
}

void Help::open() {
  const QWidget* focus = QApplication::focusWidget();
  const QString page = page_of(focus ? focus : QApplication::activeWindow(), window_);
  // Pages of other languages than English lie in a folder of theirs, where there are any.
  QStringList places;
  for (const QString& folder : folders_) {
    places << QStringLiteral("%1/%2/%3.html").arg(folder, used_language(), page)
           << QStringLiteral("%1/%2.html").arg(folder, page);
  }
  for (const QString& place : places) {
    const QFileInfo file(place);
    if (!file.exists()) continue;
    if (QDesktopServices::openUrl(QUrl::fromLocalFile(file.canonicalFilePath()))) {
      return window_.dismiss_about(kAboutHandbook);
    }
    return window_.tell(
        tr("No browser could be started. The handbook's page is %1").arg(file.canonicalFilePath()),
        kAboutHandbook);
  }
  window_.tell(
      tr("The handbook is not installed beside this program. Its pages are in the folder handbook of "
         "Tidemark's source, and the target handbook of its build makes them."),
      kAboutHandbook);
}

}  // namespace tidemark::ui
