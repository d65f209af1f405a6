#include "document/lesson_copy.h"

#include <algorithm>
#include <cmath>

#include "core/atomic_file.h"
#include "core/json/json.h"
#include "core/json/json_field.h"
#include "core/text_file.h"
#include "document/recovery_folder.h"

namespace tidemark::document {
namespace {

constexpr int kAnswersVersion = 1;
constexpr const char* kAnswersFormat = "tidemark lesson answers";
constexpr const char* kSuffix = ".lesson";
constexpr std::size_t kLargestCopy = 3 * Lesson::kLargestFile;  // a lesson's text in quotes, and answers
constexpr std::size_t kLongestAnswer = 4 * Lesson::kLongestLine;

std::filesystem::path copy_file(const std::filesystem::path& folder, const std::string& id) {
  return folder / (id + kSuffix);
}

Json to_json(const PartAnswers& given, bool tried) {
  Json json{{"tried", tried}, {"words", given.words}, {"figures", Json::array()}};
  if (given.choice) json["choice"] = *given.choice;
  for (const auto& figure : given.figures) {
    const bool is_number = figure && std::isfinite(*figure);
    json["figures"].push_back(is_number ? Json(*figure) : Json("none"));
  }
  return json;
}

PartAnswers read_part(const JsonField& field, const LessonPart& part) {
  PartAnswers given;
  given.words = field.at("words").text(kLongestAnswer);
  if (field.has("choice")) {
    const std::size_t choices = part.question ? part.question->choices.size() : 0;
    if (choices == 0) field.at("choice").wrong("answers no question");
    given.choice = static_cast<std::size_t>(
        field.at("choice").integer(0, static_cast<std::int64_t>(std::max<std::size_t>(choices, 1)) - 1));
  }
  const JsonField figures = field.at("figures");
  const std::size_t count = figures.size(part.measures.size());
  for (std::size_t i = 0; i < count; ++i) {
    const JsonField figure = figures.at(i);
    if (figure.is_text()) {
      given.figures.emplace_back();
    } else {
      given.figures.emplace_back(figure.number());
    }
  }
  if (count != 0 && count != part.measures.size()) figures.wrong("has not one number a measure");
  return given;
}

Result<RescuedLesson> read_copy(const std::filesystem::path& file) {
  const std::string name = file.string();
  const auto text = read_text_file(file, kLargestCopy);
  if (!text) return pass_on(text);
  const auto json = JsonDocument::parse(*text, name, {.bytes = kLargestCopy, .depth = 6});
  if (!json) return pass_on(json);
  const JsonField root = root_of(*json, name);
  root.at("format").must_be(kAnswersFormat);
  static_cast<void>(root.at("version").integer(kAnswersVersion, kAnswersVersion));
  RescuedLesson found;
  found.copy = file;
  const std::string lesson_file = root.at("file").text();
  if (lesson_file.find('\0') != std::string::npos) root.at("file").wrong("names no path");
  found.file = lesson_file;
  const std::string lesson_text = root.at("lesson").text(Lesson::kLargestFile);
  if (!root.good()) return pass_on(root.status());
  auto lesson = Lesson::parse(lesson_text, name);
  if (!lesson) return pass_on(lesson);
  found.lesson = std::move(*lesson);
  const std::size_t count = found.lesson.parts.size();
  found.progress.part =
      static_cast<std::size_t>(root.at("part").integer(0, static_cast<std::int64_t>(count) - 1));
  const JsonField parts = root.at("parts");
  if (parts.size(count) != count) parts.wrong("has not one entry a part of the lesson");
  for (std::size_t i = 0; i < count && root.good(); ++i) {
    const JsonField part = parts.at(i);
    found.progress.parts.push_back(read_part(part, found.lesson.parts[i]));
    found.progress.tried.push_back(part.at("tried").boolean() ? 1 : 0);
  }
  if (!root.good()) return pass_on(root.status());
  return found;
}

}  // namespace

Result<LessonCopy> LessonCopy::create(const std::filesystem::path& folder, std::string lesson,
                                      std::filesystem::path file) {
  LessonCopy copy;
  copy.folder_ = folder;
  copy.id_ = new_copy_id();
  copy.lesson_ = std::move(lesson);
  copy.file_ = std::move(file);
  auto lock = hold_copy(folder, copy.id_);
  if (!lock) return pass_on(lock);
  copy.lock_ = std::move(*lock);
  return copy;
}

Status LessonCopy::write(const LessonProgress& progress) {
  Json json{{"format", kAnswersFormat}, {"version", kAnswersVersion}, {"file", file_.string()},
            {"lesson", lesson_},        {"part", progress.part},      {"parts", Json::array()}};
  for (std::size_t i = 0; i < progress.parts.size(); ++i)
    json["parts"].push_back(to_json(progress.parts[i], progress.tried[i] != 0));
  return write_file(copy_file(folder_, id_), json.dump(1, ' ', false, Json::error_handler_t::replace));
}

void LessonCopy::finish() {
  discard_lesson(folder_, id_);
  lock_ = FileLock();
}

std::vector<RescuedLesson> find_rescued_lessons(const std::filesystem::path& folder) {
  std::vector<RescuedLesson> found;
  for (const std::string& id : left_copies(folder, kSuffix)) {
    auto copy = read_copy(copy_file(folder, id));
    if (!copy) continue;
    copy->id = id;
    found.push_back(std::move(*copy));
  }
  return found;
}

void discard_lesson(const std::filesystem::path& folder, const std::string& id) {
  if (!is_copy_id(id)) return;
  std::error_code ignored;
  std::filesystem::remove(copy_file(folder, id), ignored);
  remove_hold(folder, id);
}

}  // namespace tidemark::document
