// The question where to save a file.
#pragma once

#include <QString>

class QWidget;

namespace tidemark::ui {

// Begins with `name` in the folder that was last saved to. `suffixes` are those of a file dialog
// ("PDF (*.pdf);;Web page (*.html)"); a name without any of them gets the first of the chosen kind. Empty:
// the user saves nothing, or does not replace the file that is there.
[[nodiscard]] QString ask_where_to_save(QWidget& parent, const QString& title, const QString& name,
                                        const QString& suffixes);

}  // namespace tidemark::ui
