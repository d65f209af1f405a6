#include "ui/opening/ask_for_study.h"

#include <QFileDialog>
#include <QFileInfo>

#include "ui/settings.h"
#include "ui/widgets/file_patterns.h"
#include "ui/widgets/tr.h"

namespace tidemark::ui {

QString ask_for_study_folder(QWidget& window) {
  const QString folder = QFileDialog::getExistingDirectory(&window, tr("Open a folder with a study"),
                                                           settings::open_folder().get());
  if (!folder.isEmpty()) settings::open_folder().set(folder);
  return folder;
}

QString ask_for_image_file(QWidget& window) {
  const QString file = QFileDialog::getOpenFileName(
      &window, tr("Open an image file"), settings::open_folder().get(),
      tr("Images (*.dcm DICOMDIR *.zip %1);;All files (*)").arg(QLatin1String(kVolumePatterns)));
  if (!file.isEmpty()) settings::open_folder().set(QFileInfo(file).path());
  return file;
}

}  // namespace tidemark::ui
