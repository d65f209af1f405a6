#include "ui/main/unfinished_work.h"

#include <QAbstractButton>
#include <QDialog>
#include <QMessageBox>
#include <QPointer>

#include "ui/widgets/tr.h"
#include "ui/widgets/work_line.h"

namespace tidemark::ui {

bool may_give_up_work(QWidget& window) {
  QList<QPointer<QDialog>> working;
  for (const WorkLine* line : window.findChildren<WorkLine*>()) {
    auto* dialog = qobject_cast<QDialog*>(line->window());
    if (dialog && line->working()) working << dialog;
  }
  for (const QPointer<QDialog>& dialog : working) {
    QMessageBox box(
        QMessageBox::Question, tr("Quit"),
        tr("“%1” is still at work: what it has not finished is given up.").arg(dialog->windowTitle()),
        QMessageBox::Cancel, &window);
    const QAbstractButton* quit = box.addButton(tr("Give it up and quit"), QMessageBox::DestructiveRole);
    box.setDefaultButton(QMessageBox::Cancel);
    box.exec();
    if (box.clickedButton() != quit) return false;
    if (dialog) dialog->reject();
  }
  return true;
}

}  // namespace tidemark::ui
