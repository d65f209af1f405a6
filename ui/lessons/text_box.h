// A field for paragraphs of plain text, and numbers as lessons need them.
#pragma once

#include <QLineEdit>
#include <QPlainTextEdit>
#include <string>

#include "ui/widgets/number_box.h"

namespace tidemark::ui {

// That many lines high. Tab goes on to the next control.
[[nodiscard]] QPlainTextEdit* make_text_box(int lines);
// Without a signal; the cursor stays where the text is the same.
void show_text(QPlainTextEdit& box, const std::string& text);
void show_text(QLineEdit& line, const std::string& text);

[[nodiscard]] NumberBox* make_number_box(double low, double high, int decimals);
// Without a signal. With more digits behind the point where the value has more than `decimals`.
void show_number(NumberBox& box, double value, int decimals);

}  // namespace tidemark::ui
