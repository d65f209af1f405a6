// The figures of lessons as text for people.
#pragma once

#include <QString>

#include "document/lesson.h"

namespace tidemark::ui {

[[nodiscard]] QString figure_title(const std::string& figure);               // "Volume"
[[nodiscard]] QString figure_text(const std::string& figure, double value);  // "33.51 ml"
[[nodiscard]] QString range_text(const document::LessonMeasure& measure);    // "33 to 34 ml"

}  // namespace tidemark::ui
