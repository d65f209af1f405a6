// A question that waits for its answer.
#pragma once

#include <QMessageBox>

namespace tidemark::ui {

// The text stands there as it is: nothing in it is taken for HTML, whatever names from files it holds.
// `proposed` is Return's answer.
[[nodiscard]] QMessageBox::StandardButton ask(QWidget* parent, const QString& title, const QString& text,
                                              QMessageBox::StandardButtons answers,
                                              QMessageBox::StandardButton proposed);

}  // namespace tidemark::ui
