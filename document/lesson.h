// A lesson: a study, and parts in which a student predicts, tries, measures and reads why. A file of data.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "document/start.h"
#include "solver/parameters.h"

namespace tidemark::document {

// A phantom, or a file or folder that lies beside the lesson's file.
struct LessonStudy {
  std::string phantom;         // as imaging::named_phantom() takes it: "sphere", "sphere:20"; empty: a file
  std::filesystem::path file;  // relative, and not above the lesson's folder

  bool operator==(const LessonStudy&) const = default;
};

// What a student is asked before the try.
struct LessonQuestion {
  std::string text;
  std::vector<std::string> choices;  // empty: the answer is in words
  std::optional<std::size_t> right;  // of the choices; unset: none is wrong

  bool operator==(const LessonQuestion&) const = default;
};

// What the views show beside the surface during a try.
enum class LessonView { contours, pages, speed, truth };
[[nodiscard]] std::span<const std::string_view> lesson_view_names();  // in the order of LessonView

// The level set that a part is about, and how far it runs.
struct LessonTry {
  bool goes_on = false;        // from where the part before has ended; else from the lesson's start
  std::optional<Start> start;  // in place of the lesson's
  solver::Parameters parameters;
  double smoothed_mm = 0.0;
  std::int64_t steps = 0;   // 0: nothing is computed
  bool until_rest = false;  // ends before, where the surface rests
  std::vector<LessonView> show;
};

// A figure that is measured after the try, and what it should be.
struct LessonMeasure {
  std::string figure;  // of lesson_figures()
  double low = 0.0;    // the expected range, in the figure's unit
  double high = 0.0;

  bool operator==(const LessonMeasure&) const = default;
  [[nodiscard]] bool holds(double value) const { return value >= low && value <= high; }
};

struct LessonPart {
  std::string title;
  std::string text;
  std::optional<LessonStudy> study;  // in place of the lesson's
  std::optional<LessonQuestion> question;
  std::optional<LessonTry> attempt;  // unset: a part to read
  std::vector<LessonMeasure> measures;
  std::string explanation;  // shown when all is measured
};

// Texts are plain; an empty line ends a paragraph.
struct Lesson {
  static constexpr int kVersion = 1;
  static constexpr std::size_t kLargestFile = std::size_t{16} << 20;  // bytes
  static constexpr std::size_t kMostParts = 100;
  static constexpr std::size_t kMostChoices = 10;
  static constexpr std::int64_t kMostSteps = 1'000'000;
  static constexpr std::size_t kLongestLine = 300;   // bytes: titles, choices
  static constexpr std::size_t kLongestText = 8000;  // bytes

  std::string title;
  std::string about;  // one sentence
  std::string author;
  int minutes = 0;  // that a student needs; 0: not said
  LessonStudy study;
  std::optional<Start> start;     // unset: the phantom's own
  solver::Parameters parameters;  // from which those of the parts differ
  std::vector<LessonPart> parts;

  // The study of a part.
  [[nodiscard]] const LessonStudy& study_of(const LessonPart& part) const {
    return part.study ? *part.study : study;
  }
  // The start of a part whose try does not go on; null: the phantom's own.
  [[nodiscard]] const Start* start_of(const LessonPart& part) const;

  // Fails (ErrorKind::input) naming `file` and the field: not JSON, an unknown version or name, something
  // missing or beyond its limit, a try that cannot be carried out.
  static Result<Lesson> parse(std::string_view text, const std::string& file);
  static Result<Lesson> load(const std::filesystem::path& file);
  // JSON. Fails (ErrorKind::usage) as parse() would.
  [[nodiscard]] Result<std::string> to_text() const;
};

// A lesson of the program's own.
struct OwnLesson {
  std::string_view name;  // "2-curvature-flow"
  std::string_view text;  // for Lesson::parse()
};
// In the order in which they are taught.
[[nodiscard]] std::span<const OwnLesson> own_lessons();

}  // namespace tidemark::document
