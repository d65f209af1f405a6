// Copies of the answers of a lesson that is being done, which outlive a crash. They lie beside those of
// cases.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/file_lock.h"
#include "document/lesson_answers.h"

namespace tidemark::document {

// How far a student has come. Neither a name nor a date is part of it.
struct LessonProgress {
  std::size_t part = 0;            // that is shown
  std::vector<PartAnswers> parts;  // one a part
  std::vector<char> tried;         // one a part

  bool operator==(const LessonProgress&) const = default;
};

// Writes the copies of one lesson, each in place of the one before. One thread at a time uses it.
class LessonCopy {
 public:
  // `lesson` is its text, and `file` where it lies; empty: one of the program's own. Fails (ErrorKind::write)
  // where the folder cannot be used.
  static Result<LessonCopy> create(const std::filesystem::path& folder, std::string lesson,
                                   std::filesystem::path file);

  Status write(const LessonProgress& progress);
  // The lesson was ended: removes its copy.
  void finish();

 private:
  LessonCopy() = default;
  std::filesystem::path folder_;
  std::string id_;
  std::string lesson_;
  std::filesystem::path file_;
  FileLock lock_;
};

// A copy that can be offered.
struct RescuedLesson {
  std::string id;
  std::filesystem::path copy;
  Lesson lesson;
  std::filesystem::path file;  // of the lesson; empty: one of the program's own
  LessonProgress progress;     // fits the lesson
};
// Of lessons that were not ended and that no running program holds. A file that is no copy is left out.
std::vector<RescuedLesson> find_rescued_lessons(const std::filesystem::path& folder);
void discard_lesson(const std::filesystem::path& folder, const std::string& id);

}  // namespace tidemark::document
