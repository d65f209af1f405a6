#include "engine/lesson_autosave.h"

#include <mutex>
#include <utility>

#include "engine/background_job.h"
#include "engine/message_text.h"

namespace tidemark::engine {

// Shared with the thread that writes; made when there is something to write.
struct LessonAutosave::Copy {
  std::mutex mutex;
  std::filesystem::path folder;
  document::Lesson lesson;
  std::filesystem::path lesson_file;
  std::optional<document::LessonCopy> file;
  bool closed = false;

  Status write(const document::LessonProgress& progress) {
    const std::lock_guard lock(mutex);
    if (closed) return {};
    if (!file) {
      const auto text = lesson.to_text();
      if (!text) return pass_on(text);
      auto made = document::LessonCopy::create(folder, *text, lesson_file);
      if (!made) return pass_on(made);
      file.emplace(std::move(*made));
    }
    return file->write(progress);
  }

  void close() {
    const std::lock_guard lock(mutex);
    closed = true;
    if (file) file->finish();
    file.reset();
  }
};

LessonAutosave::LessonAutosave(LessonCourse& course, std::filesystem::path file, std::filesystem::path folder,
                               std::chrono::milliseconds retry)
    : course_(course), copy_(std::make_shared<Copy>()), retry_(retry) {
  copy_->folder = std::move(folder);
  copy_->lesson = course.lesson();
  copy_->lesson_file = std::move(file);
  timer_.setSingleShot(true);
  connect(&course_, &LessonCourse::changed, this, &LessonAutosave::follow);
  connect(&timer_, &QTimer::timeout, this, &LessonAutosave::save);
  follow();  // a rescued lesson is in no file but the copy that it came from
}

LessonAutosave::~LessonAutosave() {
  if (job_) job_->abandon();
  // Waiting for a copy that is being written could block the user interface.
  BackgroundJob::start(this, [copy = copy_](BackgroundJob&) { copy->close(); })->abandon();
}

void LessonAutosave::follow() {
  if (writing_ || timer_.isActive() || !course_.begun() || course_.progress() == seen_) return;
  timer_.start(kDelay);
}

void LessonAutosave::save() {
  seen_ = course_.progress();
  writing_ = true;
  job_ = BackgroundJob::start(
      this,
      [this, copy = copy_, progress = seen_](BackgroundJob& job) {
        const Status status = copy->write(progress);
        job.deliver([this, status] { copied(status); });
      },
      [this](const Error& error) { copied(tl::unexpected<Error>(error)); });
}

void LessonAutosave::copied(const Status& status) {
  writing_ = false;
  const bool fails_again = std::exchange(fails_, !status.has_value());
  if (status) {
    emit saved();
    return follow();
  }
  timer_.start(retry_);
  if (!fails_again) emit failed(message_text(status.error()));
}

}  // namespace tidemark::engine
