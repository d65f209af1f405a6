// Dialogs that ask which study to open.
#pragma once

#include <QString>

class QWidget;

namespace tidemark::ui {

// Begin in the folder that was used last; empty when given up.
QString ask_for_study_folder(QWidget& window);
QString ask_for_image_file(QWidget& window);

}  // namespace tidemark::ui
