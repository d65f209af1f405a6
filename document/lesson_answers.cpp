#include "document/lesson_answers.h"

#include <fmt/format.h>

#include <string_view>
#include <vector>

#include "document/lesson_figure.h"

namespace tidemark::document {
namespace {

std::string csv_text(std::string_view text) {
  std::string field = "\"";
  const bool like_formula =
      !text.empty() && std::string_view("=+-@\t\r").find(text.front()) != std::string_view::npos;
  if (like_formula) field += '\'';
  for (const char c : text) {
    if (c == '"') field += '"';
    field += c;
  }
  return field + '"';
}

void add_line(std::string& csv, const std::vector<std::string>& fields) {
  csv += fmt::format("{}\r\n", fmt::join(fields, ","));
}

// Of one part; what a student has not come to is empty.
const PartAnswers& answers_to(const LessonAnswers& answers, std::size_t part) {
  static const PartAnswers kNone;
  return part < answers.parts.size() ? answers.parts[part] : kNone;
}

// What the student says; empty: nothing.
std::string_view answer_of(const LessonQuestion& question, const PartAnswers& given) {
  if (question.choices.empty()) return given.words;
  if (given.choice && *given.choice < question.choices.size()) return question.choices[*given.choice];
  return {};
}

std::string_view verdict(bool known, bool good) {
  if (!known) return "";
  return good ? "yes" : "no";
}

}  // namespace

LessonScore score(const Lesson& lesson, const LessonAnswers& answers) {
  LessonScore score;
  for (std::size_t i = 0; i < lesson.parts.size(); ++i) {
    const LessonPart& part = lesson.parts[i];
    const PartAnswers& given = answers_to(answers, i);
    if (part.question && part.question->right) {
      ++score.questions;
      score.right += given.choice == part.question->right ? 1 : 0;
    }
    for (std::size_t m = 0; m < part.measures.size(); ++m) {
      ++score.figures;
      const bool measured = m < given.figures.size() && given.figures[m].has_value();
      score.in_range += measured && part.measures[m].holds(*given.figures[m]) ? 1 : 0;
    }
  }
  return score;
}

std::string to_csv(const Lesson& lesson, const LessonAnswers& answers) {
  std::string csv;
  add_line(csv, {"student", "date", "lesson", "part", "title", "asked", "answer", "expected", "agrees"});
  for (std::size_t i = 0; i < lesson.parts.size(); ++i) {
    const LessonPart& part = lesson.parts[i];
    const PartAnswers& given = answers_to(answers, i);
    const auto line = [&](std::string_view asked, const std::string& answer, const std::string& expected,
                          std::string_view agrees) {
      add_line(csv, {csv_text(answers.student), csv_text(answers.date), csv_text(lesson.title),
                     std::to_string(i + 1), csv_text(part.title), csv_text(asked), answer, expected,
                     std::string(agrees)});
    };
    if (part.question) {
      const LessonQuestion& question = *part.question;
      line(question.text, csv_text(answer_of(question, given)),
           csv_text(question.right ? question.choices[*question.right] : ""),
           verdict(question.right.has_value(), given.choice == question.right));
    }
    for (std::size_t m = 0; m < part.measures.size(); ++m) {
      const LessonMeasure& measure = part.measures[m];
      const bool measured = m < given.figures.size() && given.figures[m].has_value();
      line(measure.figure, measured ? fmt::format("{:.6g}", *given.figures[m]) : std::string(),
           fmt::format("{:.6g} to {:.6g}", measure.low, measure.high),
           verdict(true, measured && measure.holds(*given.figures[m])));
    }
  }
  return csv;
}

}  // namespace tidemark::document
