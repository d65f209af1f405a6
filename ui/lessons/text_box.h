// The fields of the forms of lessons: paragraphs of plain text, numbers, groups that fold.
#pragma once

#include <QGroupBox>
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

// The inside of a group with a check box, which is shown while that is checked.
[[nodiscard]] QWidget* make_content(QGroupBox& group);

[[nodiscard]] NumberBox* make_number_box(double low, double high, int decimals);
// Without a signal. With more digits behind the point where the value has more than `decimals`.
void show_number(NumberBox& box, double value, int decimals);

}  // namespace tidemark::ui
