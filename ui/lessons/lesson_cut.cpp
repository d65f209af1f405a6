#include "ui/lessons/lesson_cut.h"

#include <string_view>

namespace tidemark::ui {
namespace {

constexpr std::string_view kLeftOut = "left out";

}  // namespace

document::Lesson cut_after(const document::Lesson& lesson, std::size_t last) {
  document::Lesson cut = lesson;
  cut.parts.resize(last + 1);
  cut.title = kLeftOut;
  cut.about.clear();
  cut.author.clear();
  bool is_needed = true;
  for (std::size_t i = last + 1; i-- > 0;) {
    document::LessonPart& part = cut.parts[i];
    part.title = kLeftOut;
    part.text = kLeftOut;
    part.question.reset();
    part.explanation.clear();
    if (i != last) part.measures.clear();
    if (!is_needed) part.attempt.reset();
    if (part.attempt && !part.attempt->goes_on) is_needed = false;
  }
  return cut;
}

}  // namespace tidemark::ui
