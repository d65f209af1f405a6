#include "ui/main/ask_for_labels.h"

#include <QPointer>
#include <utility>

#include "ui/main/case_window.h"
#include "ui/main/main_window.h"
#include "ui/settings.h"
#include "ui/widgets/file_patterns.h"

namespace tidemark::ui {

void ask_for_labels(QWidget& parent, CaseWindow& of, const QString& title,
                    std::function<void(CaseWindow& of, const QString& file)> take,
                    QFileDialog::FileMode mode) {
  auto* dialog =
      new QFileDialog(&parent, title, settings::save_folder().get(),
                      MainWindow::tr("Masks, label maps and segmentations (*.dcm %1);;All files (*)")
                          .arg(QLatin1String(kVolumePatterns)));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(mode);
  QObject::connect(dialog, &QFileDialog::filesSelected, &parent,
                   [of = QPointer(&of), take = std::move(take)](const QStringList& files) {
                     for (const QString& file : files) {
                       if (of) take(*of, file);
                     }
                   });
  dialog->open();
}

}  // namespace tidemark::ui
