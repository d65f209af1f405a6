// The answers of a student to a lesson, for a file that the student hands in.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "document/lesson.h"

namespace tidemark::document {

struct PartAnswers {
  std::optional<std::size_t> choice;           // of the question's
  std::string words;                           // the answer in words
  std::vector<std::optional<double>> figures;  // in the order of the measures; empty: not measured

  bool operator==(const PartAnswers&) const = default;
};

struct LessonAnswers {
  std::string student;
  std::string date;                // "2026-03-31"
  std::vector<PartAnswers> parts;  // one a part
};

// How many questions with a right answer there are, how many of them were answered so, and the same of
// figures and their ranges.
struct LessonScore {
  int questions = 0;
  int right = 0;
  int figures = 0;
  int in_range = 0;
};
[[nodiscard]] LessonScore score(const Lesson& lesson, const LessonAnswers& answers);

// A table (RFC 4180, UTF-8): a line a question and a line a figure, with what is right or expected beside it.
// Numbers have a point. A text that a spreadsheet would take for a formula begins with an apostrophe.
[[nodiscard]] std::string to_csv(const Lesson& lesson, const LessonAnswers& answers);

}  // namespace tidemark::document
