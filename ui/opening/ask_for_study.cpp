#include "ui/opening/ask_for_study.h"

#include <QCoreApplication>
#include <QFileDialog>
#include <QFileInfo>

#include "ui/settings.h"
#include "ui/widgets/file_patterns.h"

namespace tidemark::ui {
namespace {

QString translated(const char* text) {
  return QCoreApplication::translate("tidemark::AskForStudy", text);
}

}  // namespace

QString ask_for_study_folder(QWidget& window) {
  const QString folder = QFileDialog::getExistingDirectory(
      &window, translated(QT_TRANSLATE_NOOP("tidemark::AskForStudy", "Open a folder with a study")),
      settings::open_folder().get());
  if (!folder.isEmpty()) settings::open_folder().set(folder);
  return folder;
}

QString ask_for_image_file(QWidget& window) {
  const QString file = QFileDialog::getOpenFileName(
      &window, translated(QT_TRANSLATE_NOOP("tidemark::AskForStudy", "Open an image file")),
      settings::open_folder().get(),
      translated(
          QT_TRANSLATE_NOOP("tidemark::AskForStudy", "Images (*.dcm DICOMDIR *.zip %1);;All files (*)"))
          .arg(QLatin1String(kVolumePatterns)));
  if (!file.isEmpty()) settings::open_folder().set(QFileInfo(file).path());
  return file;
}

}  // namespace tidemark::ui
