// The dialog for a file with masks or labels: a mask, a label map, a DICOM Segmentation or a structure set.
#pragma once

#include <QFileDialog>
#include <QString>
#include <functional>

namespace tidemark::ui {

class CaseWindow;

// `take` is called with each file that the user chose, unless the case is closed by then.
void ask_for_labels(QWidget& parent, CaseWindow& of, const QString& title,
                    std::function<void(CaseWindow& of, const QString& file)> take,
                    QFileDialog::FileMode mode = QFileDialog::ExistingFile);

}  // namespace tidemark::ui
