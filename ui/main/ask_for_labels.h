// The dialog for a file with masks or labels: a mask, a label map, a DICOM Segmentation or a structure set.
#pragma once

#include <QString>
#include <functional>

namespace tidemark::ui {

class CaseWindow;
class MainWindow;

// `take` is called with the file that the user chose, unless the case is closed by then.
void ask_for_labels(MainWindow& window, CaseWindow& of, const QString& title,
                    std::function<void(CaseWindow& of, const QString& file)> take);

}  // namespace tidemark::ui
