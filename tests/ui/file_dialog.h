// Names given to file dialogs, as by hand.
#pragma once

#include <QApplication>
#include <QFileDialog>
#include <QLineEdit>
#include <QTest>
#include <QTimer>

namespace tidemark::test {

// Accepts the dialog with that file. Keys would open a list of names; selectFile() leaves a line that has the
// focus.
inline void name_file(QFileDialog& dialog, const QString& file) {
  auto* name = dialog.findChild<QLineEdit*>("fileNameEdit");
  name->setText(file);
  QTest::keyClick(name, Qt::Key_Return);
}

// The same of the next dialog that waits in a loop of its own.
inline void name_file_when_asked(const QString& file) {
  auto* timer = new QTimer(qApp);
  QObject::connect(timer, &QTimer::timeout, timer, [timer, file] {
    auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
    if (!dialog) return;
    timer->stop();
    timer->deleteLater();
    name_file(*dialog, file);
  });
  timer->start(20);
}

}  // namespace tidemark::test
