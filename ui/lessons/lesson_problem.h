// The first problem of a lesson, as a sentence for its author.
#pragma once

#include <QString>
#include <optional>
#include <string>

#include "document/lesson.h"

namespace tidemark::ui {

struct LessonProblem {
  QString sentence;                 // "Part 2 “A ball shrinks”, question, text: is empty"
  std::optional<std::size_t> part;  // unset: the lesson itself
};

// By Lesson::to_text(). Masks and fields of starts are not looked at, as they come from cases; so that a
// large one does not hold up who types.
[[nodiscard]] std::optional<LessonProblem> problem_of(const document::Lesson& lesson);
// The same where the parts have their titles in another lesson.
[[nodiscard]] std::optional<LessonProblem> problem_of(const document::Lesson& lesson,
                                                      const document::Lesson& titled);

// A message of Lesson::parse() or to_text() without a file's name, in words.
[[nodiscard]] LessonProblem in_words(const std::string& message, const document::Lesson& lesson);

}  // namespace tidemark::ui
