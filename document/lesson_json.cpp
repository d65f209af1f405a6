#include <algorithm>
#include <array>

#include "core/json/json_text.h"
#include "core/text_file.h"
#include "document/lesson.h"
#include "document/lesson_figure_names.h"
#include "document/recipe_json.h"
#include "imaging/filters/filters.h"
#include "imaging/phantom/phantom_name.h"

namespace tidemark::document {
namespace {

constexpr const char* kLessonFormat = "tidemark lesson";
constexpr std::size_t kMostMeasures = 10;
constexpr std::size_t kMostLessonSpheres = 1000;
constexpr std::int64_t kMostMinutes = 1000;
constexpr double kLargestFigure = 1e12;
constexpr std::array<std::string_view, 4> kViews{"contours", "pages", "speed", "truth"};

// Of ASCII, or of those that UTF-8 writes with two bytes (U+0080 to U+009F): terminals act on either.
bool has_control_character(std::string_view text, std::string_view allowed) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const bool is_ascii_control = byte < ' ' || byte == 0x7f;
    if (is_ascii_control && allowed.find(text[i]) == std::string_view::npos) return true;
    if (byte == 0xc2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xa0) return true;
  }
  return false;
}

// Something that can be read, without control characters but `allowed` ones.
std::string read_plain(const JsonField& field, std::size_t longest, std::string_view allowed) {
  std::string text = field.text(longest);
  if (!field.good()) return {};
  if (text.find_first_not_of(" \t\n") == std::string::npos) field.wrong("is empty");
  if (has_control_character(text, allowed)) field.wrong("holds a control character");
  return text;
}

std::string read_line(const JsonField& field) {
  return read_plain(field, Lesson::kLongestLine, "");
}

std::string read_text(const JsonField& field) {
  return read_plain(field, Lesson::kLongestText, "\n\t");
}

LessonStudy read_study(const JsonField& field) {
  field.only({"phantom", "file"});
  LessonStudy study;
  if (field.has("phantom")) {
    study.phantom = read_line(field.at("phantom"));
    if (const auto name = imaging::parse_phantom_name(study.phantom); field.good() && !name) {
      field.at("phantom").wrong(name.error().message);
    }
    if (field.has("file")) field.wrong("has a phantom and a file");
    return study;
  }
  study.file = read_line(field.at("file"));
  const bool above = std::find(study.file.begin(), study.file.end(), "..") != study.file.end();
  if (field.good() && (study.file.empty() || study.file.is_absolute() || above)) {
    field.at("file").wrong("must be a path below the lesson's folder");
  }
  return study;
}

Json to_json(const LessonStudy& study) {
  if (!study.phantom.empty()) return {{"phantom", study.phantom}};
  return {{"file", study.file.generic_string()}};
}

LessonQuestion read_question(const JsonField& field) {
  field.only({"text", "choices", "right"});
  LessonQuestion question;
  question.text = read_text(field.at("text"));
  if (!field.has("choices")) {
    if (field.has("right")) field.at("right").wrong("needs choices");
    return question;
  }
  const JsonField choices = field.at("choices");
  const std::size_t count = choices.size(Lesson::kMostChoices);
  if (count < 2) choices.wrong("needs two or more");
  for (std::size_t i = 0; i < count && field.good(); ++i) {
    question.choices.push_back(read_line(choices.at(i)));
  }
  if (field.has("right")) {
    const auto last = static_cast<std::int64_t>(question.choices.size());
    question.right = static_cast<std::size_t>(field.at("right").integer(1, last) - 1);
  }
  return question;
}

Json to_json(const LessonQuestion& question) {
  Json json{{"text", question.text}};
  if (!question.choices.empty()) json["choices"] = question.choices;
  if (question.right) json["right"] = *question.right + 1;
  return json;
}

// What is missing is nothing. Masks and saved level sets are of one study's grid, and no hand writes them.
Start read_lesson_start(const JsonField& field) {
  field.only({"from", "seeds", "erasers", "levels"});
  if (field.has("from")) {
    const JsonField from = field.at("from");
    switch (from.at("kind").word({"spheres", "threshold", "flood"})) {
      case 0:
        from.only({"kind"});
        break;
      case 1:
        from.only({"kind", "low", "high"});
        break;
      default:
        from.only({"kind", "voxel", "low", "high"});
        break;
    }
  }
  for (const char* list : {"seeds", "erasers"}) {
    if (!field.has(list)) continue;
    const JsonField spheres = field.at(list);
    const std::size_t count = spheres.size(kMostLessonSpheres);
    for (std::size_t i = 0; i < count && field.good(); ++i) spheres.at(i).only({"centre_mm", "radius_mm"});
  }
  if (!field.good()) return {};
  Start start = read_partial_start(field);
  if (field.good() && start.empty()) field.wrong("has nothing inside");
  return start;
}

LessonTry read_try(const JsonField& field, const Lesson& lesson) {
  field.only({"goes_on", "start", "parameters", "smoothed_mm", "steps", "until_rest", "show"});
  LessonTry attempt;
  if (field.has("goes_on")) attempt.goes_on = field.at("goes_on").boolean();
  if (field.has("start")) {
    if (attempt.goes_on) field.at("start").wrong("contradicts goes_on");
    attempt.start = read_lesson_start(field.at("start"));
  }
  attempt.parameters = lesson.parameters;
  if (field.has("parameters")) {
    attempt.parameters = read_changed_parameters(field.at("parameters"), lesson.parameters);
  }
  if (field.has("smoothed_mm")) {
    attempt.smoothed_mm = field.at("smoothed_mm").number(0.0, imaging::kMostSmoothing_mm);
  }
  attempt.steps = field.at("steps").integer(0, Lesson::kMostSteps);
  if (field.has("until_rest")) attempt.until_rest = field.at("until_rest").boolean();
  if (field.has("show")) {
    const JsonField show = field.at("show");
    const std::size_t count = show.size(kViews.size());
    for (std::size_t i = 0; i < count && field.good(); ++i) {
      attempt.show.push_back(static_cast<LessonView>(show.at(i).word({kViews.begin(), kViews.end()})));
    }
  }
  return attempt;
}

Json to_json(const LessonTry& attempt, const Lesson& lesson) {
  Json json;
  if (attempt.goes_on) json["goes_on"] = true;
  if (attempt.start) json["start"] = to_json(*attempt.start);
  Json parameters = changed_parameters(attempt.parameters, lesson.parameters);
  if (!parameters.empty()) json["parameters"] = std::move(parameters);
  if (attempt.smoothed_mm > 0.0) json["smoothed_mm"] = attempt.smoothed_mm;
  json["steps"] = attempt.steps;
  if (attempt.until_rest) json["until_rest"] = true;
  for (const LessonView view : attempt.show) json["show"].push_back(kViews[static_cast<std::size_t>(view)]);
  return json;
}

std::string read_figure(const JsonField& field) {
  std::string name = read_line(field);
  const bool known = std::find(kFigureNames.begin(), kFigureNames.end(), name) != kFigureNames.end();
  if (field.good() && !known) {
    field.wrong(fmt::format("'{}' is unknown; there are {}", name, fmt::join(kFigureNames, ", ")));
  }
  return name;
}

std::vector<LessonMeasure> read_measures(const JsonField& field) {
  std::vector<LessonMeasure> measures;
  const std::size_t count = field.size(kMostMeasures);
  for (std::size_t i = 0; i < count && field.good(); ++i) {
    const JsonField at = field.at(i);
    at.only({"figure", "low", "high"});
    LessonMeasure measure;
    measure.figure = read_figure(at.at("figure"));
    measure.low = at.at("low").number(-kLargestFigure, kLargestFigure);
    measure.high = at.at("high").number(at.good() ? measure.low : -kLargestFigure, kLargestFigure);
    measures.push_back(std::move(measure));
  }
  return measures;
}

Json to_json(const std::vector<LessonMeasure>& measures) {
  Json list = Json::array();
  for (const LessonMeasure& measure : measures) {
    list.push_back({{"figure", measure.figure}, {"low", measure.low}, {"high", measure.high}});
  }
  return list;
}

// Whether a try that goes on can: there is one before it on the same study, with the same band and source.
void check_that_it_goes_on(const JsonField& field, const Lesson& lesson, const LessonPart& part) {
  const auto before = std::find_if(lesson.parts.rbegin(), lesson.parts.rend(),
                                   [](const LessonPart& one) { return one.attempt.has_value(); });
  if (before == lesson.parts.rend()) return field.wrong("has nothing to go on from");
  if (!(lesson.study_of(*before) == lesson.study_of(part))) return field.wrong("goes on with another study");
  if (before->attempt->parameters.band != part.attempt->parameters.band) {
    return field.wrong("changes the band, which needs a new start");
  }
}

LessonPart read_part(const JsonField& field, const Lesson& lesson) {
  field.only({"title", "text", "study", "question", "try", "measure", "explanation"});
  LessonPart part;
  part.title = read_line(field.at("title"));
  part.text = read_text(field.at("text"));
  if (field.has("study")) part.study = read_study(field.at("study"));
  if (field.has("question")) part.question = read_question(field.at("question"));
  if (field.has("try")) part.attempt = read_try(field.at("try"), lesson);
  if (field.has("measure")) {
    if (!part.attempt) field.at("measure").wrong("needs a try");
    part.measures = read_measures(field.at("measure"));
  }
  if (field.has("explanation")) part.explanation = read_text(field.at("explanation"));
  if (!field.good() || !part.attempt) return part;
  if (part.attempt->goes_on) {
    check_that_it_goes_on(field.at("try"), lesson, part);
  } else if (lesson.study_of(part).phantom.empty() && lesson.start_of(part) == nullptr) {
    field.at("try").wrong("needs a start: only a phantom has one of its own");
  }
  return part;
}

Json to_json(const LessonPart& part, const Lesson& lesson) {
  Json json{{"title", part.title}, {"text", part.text}};
  if (part.study) json["study"] = to_json(*part.study);
  if (part.question) json["question"] = to_json(*part.question);
  if (part.attempt) json["try"] = to_json(*part.attempt, lesson);
  if (!part.measures.empty()) json["measure"] = to_json(part.measures);
  if (!part.explanation.empty()) json["explanation"] = part.explanation;
  return json;
}

Lesson read_lesson(const JsonField& field) {
  Lesson lesson;
  field.at("format").must_be(kLessonFormat);
  const JsonField version = field.at("version");
  if (version.integer(0, 1 << 30) != Lesson::kVersion) version.wrong("this version cannot be read");
  if (!field.good()) return lesson;
  field.only(
      {"format", "version", "title", "about", "author", "minutes", "study", "start", "parameters", "parts"});
  lesson.title = read_line(field.at("title"));
  if (field.has("about")) lesson.about = read_text(field.at("about"));
  if (field.has("author")) lesson.author = read_line(field.at("author"));
  if (field.has("minutes")) lesson.minutes = static_cast<int>(field.at("minutes").integer(0, kMostMinutes));
  lesson.study = read_study(field.at("study"));
  if (field.has("start")) {
    lesson.start = read_lesson_start(field.at("start"));
  }
  const JsonField parameters = field.at("parameters");
  for (const char* key : {"target", "range", "alpha"}) static_cast<void>(parameters.at(key).number());
  lesson.parameters = read_changed_parameters(parameters, {});
  const JsonField parts = field.at("parts");
  const std::size_t count = parts.size(Lesson::kMostParts);
  if (count == 0) parts.wrong("has no part");
  for (std::size_t i = 0; i < count && field.good(); ++i) {
    lesson.parts.push_back(read_part(parts.at(i), lesson));
  }
  return lesson;
}

Json lesson_json(const Lesson& lesson) {
  Json json{{"format", kLessonFormat}, {"version", Lesson::kVersion}, {"title", lesson.title}};
  if (!lesson.about.empty()) json["about"] = lesson.about;
  if (!lesson.author.empty()) json["author"] = lesson.author;
  if (lesson.minutes > 0) json["minutes"] = lesson.minutes;
  json["study"] = to_json(lesson.study);
  if (lesson.start) json["start"] = to_json(*lesson.start);
  Json parameters = changed_parameters(lesson.parameters, {});
  parameters["target"] = lesson.parameters.target;
  parameters["range"] = lesson.parameters.range;
  parameters["alpha"] = lesson.parameters.alpha;
  json["parameters"] = std::move(parameters);
  json["parts"] = Json::array();
  for (const LessonPart& part : lesson.parts) json["parts"].push_back(to_json(part, lesson));
  return json;
}

}  // namespace

std::span<const std::string_view> lesson_view_names() {
  return kViews;
}

const Start* Lesson::start_of(const LessonPart& part) const {
  if (part.attempt && part.attempt->start) return &*part.attempt->start;
  if (part.study && !(*part.study == study)) return nullptr;  // the lesson's start is on its own study
  return start ? &*start : nullptr;
}

Result<Lesson> Lesson::parse(std::string_view text, const std::string& file) {
  const auto json = JsonDocument::parse(text, file, {.bytes = kLargestFile});
  if (!json) return pass_on(json);
  const JsonField root = root_of(*json, file);
  Lesson lesson = read_lesson(root);
  if (!root.good()) return pass_on(root.status());
  return lesson;
}

Result<Lesson> Lesson::load(const std::filesystem::path& file) {
  const auto text = read_text_file(file, kLargestFile);
  if (!text) return pass_on(text);
  return parse(*text, file.string());
}

Result<std::string> Lesson::to_text() const {
  std::string text = json_text(lesson_json(*this));
  if (const auto again = parse(text, ""); !again) return fail(ErrorKind::usage, "{}", again.error().message);
  return text;
}

}  // namespace tidemark::document
