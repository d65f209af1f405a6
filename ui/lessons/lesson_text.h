// The figures of lessons as text for people.
#pragma once

#include <QString>

#include "document/lesson.h"
#include "document/lesson_figure.h"

namespace tidemark::ui {

// A text of a lesson: of the program's own in the user's language, of others as it is.
[[nodiscard]] QString lesson_words(const std::string& words);
[[nodiscard]] QString figure_title(std::string_view figure);                  // "Volume"
[[nodiscard]] QString title_with_unit(const document::LessonFigure& figure);  // "Volume (ml)"
[[nodiscard]] QString figure_text(const std::string& figure, double value);   // "33.51 ml"
[[nodiscard]] QString range_text(const document::LessonMeasure& measure);     // "33 to 34 ml"

}  // namespace tidemark::ui
