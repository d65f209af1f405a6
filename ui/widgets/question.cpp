#include "ui/widgets/question.h"

namespace tidemark::ui {

QMessageBox::StandardButton ask(QWidget* parent, const QString& title, const QString& text,
                                QMessageBox::StandardButtons answers, QMessageBox::StandardButton proposed) {
  QMessageBox box(QMessageBox::Question, title, text, answers, parent);
  box.setTextFormat(Qt::PlainText);
  box.setDefaultButton(proposed);
  box.exec();
  return box.standardButton(box.clickedButton());
}

}  // namespace tidemark::ui
