#include "ui/widgets/save_file.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QRegularExpression>

#include "ui/settings.h"
#include "ui/widgets/question.h"
#include "ui/widgets/tr.h"

namespace tidemark::ui {
namespace {

// A name that has none of the endings of a filter ("NIfTI (*.nii.gz *.nii)") gets the first: the suffix says
// which format is written, and a name may have dots of its own.
QString with_suffix(const QString& file, const QString& chosen, const QString& all) {
  static const QRegularExpression kEnding(QStringLiteral("\\*(\\.[\\w.]+)"));
  for (auto endings = kEnding.globalMatch(all); endings.hasNext();) {
    if (file.endsWith(endings.next().captured(1), Qt::CaseInsensitive)) return file;
  }
  return file + kEnding.match(chosen).captured(1);
}

}  // namespace

QString ask_where_to_save(QWidget& parent, const QString& title, const QString& name,
                          const QString& suffixes) {
  QFileDialog dialog(&parent, title, settings::save_folder().get(), suffixes);
  dialog.setAcceptMode(QFileDialog::AcceptSave);
  dialog.selectFile(name);
  if (dialog.exec() != QDialog::Accepted || dialog.selectedFiles().isEmpty()) return {};
  const QString named = dialog.selectedFiles().first();
  const QString file = with_suffix(named, dialog.selectedNameFilter(), suffixes);
  // The dialog has asked about the name as it was typed.
  if (file != named && QFileInfo::exists(file) &&
      ask(&parent, title, tr("%1 exists. Replace it?").arg(file), QMessageBox::Yes | QMessageBox::No,
          QMessageBox::No) != QMessageBox::Yes) {
    return {};
  }
  settings::save_folder().set(QFileInfo(file).absolutePath());
  return file;
}

}  // namespace tidemark::ui
