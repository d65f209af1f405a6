#include "ui/main/server_query.h"

#include "ui/main/main_window.h"
#include "ui/pacs/query_dialog.h"

namespace tidemark::ui {

QueryDialog& query_server(MainWindow& window) {
  auto* dialog = window.findChild<QueryDialog*>();
  if (dialog == nullptr) {
    dialog = new QueryDialog(imaging::pacs_configuration_file(), &window);
    QObject::connect(dialog, &QueryDialog::retrieved, &window, &MainWindow::open);
    QObject::connect(dialog, &QueryDialog::told, &window,
                     [&window](const QString& text) { window.tell(text); });
  }
  dialog->show();
  dialog->raise();
  dialog->activateWindow();
  return *dialog;
}

}  // namespace tidemark::ui
