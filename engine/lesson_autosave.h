// A copy of the answers of the lesson that is being done.
#pragma once

#include <QObject>
#include <QTimer>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>

#include "document/lesson_copy.h"
#include "engine/lesson_course.h"

namespace tidemark::engine {

class BackgroundJob;

// Written shortly after each answer, away from the user interface. A program that dies leaves the last one
// behind, for find_rescued_lessons().
class LessonAutosave : public QObject {
  Q_OBJECT
 public:
  static constexpr int kDelay = 500;  // ms after an answer, so that words are not written letter by letter
  static constexpr std::chrono::seconds kRetry{30};  // after a copy that could not be written

  // `file` of the lesson; empty: one of the program's own. The course must outlive it.
  LessonAutosave(LessonCourse& course, std::filesystem::path file, std::filesystem::path folder,
                 std::chrono::milliseconds retry = kRetry);
  // The lesson was ended because the user wanted it: nothing is left behind.
  ~LessonAutosave() override;

 signals:
  void saved();
  void failed(const QString& message);  // of copies that fail one after the other, the first

 private:
  struct Copy;
  void follow();
  void save();
  void copied(const Status& status);

  LessonCourse& course_;
  std::shared_ptr<Copy> copy_;
  std::shared_ptr<BackgroundJob> job_;
  std::chrono::milliseconds retry_;
  QTimer timer_;
  document::LessonProgress seen_;  // in the copy, or on its way there
  bool writing_ = false;
  bool fails_ = false;  // the last copy could not be written
};

}  // namespace tidemark::engine
