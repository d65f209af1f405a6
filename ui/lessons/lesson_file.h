// The file of the lesson that is edited: opened, written, and kept before another one takes its place.
#pragma once

#include <QObject>
#include <QWidget>
#include <filesystem>
#include <functional>
#include <memory>

#include "document/lesson.h"
#include "engine/lesson_jobs.h"
#include "engine/work_queue.h"

namespace tidemark::ui {

class LessonFile : public QObject {
  Q_OBJECT
 public:
  // `lesson` is the one that is edited, `problem` why it cannot be written; empty: it can.
  LessonFile(QWidget& window, std::function<const document::Lesson&()> lesson,
             std::function<QString()> problem);

  // Another lesson is edited, which is as in that file; empty: it is in none. One that is being read comes no
  // more.
  void begin(const std::filesystem::path& file);
  void note_edit() { ++edits_; }
  [[nodiscard]] bool is_modified() const { return edits_ != saved_edits_; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path folder() const { return path_.parent_path(); }

  void ask_and_open();
  void open(const std::filesystem::path& file);
  // Files are written one after the other: the newest text stays.
  void save();
  void save_as();
  // Calls `next` when nothing would be lost by it: the user is asked where something would.
  void when_kept(std::function<void()> next);

 signals:
  void opened(const tidemark::document::Lesson& lesson, const std::filesystem::path& file);
  void saved(const QString& file);
  void said(const QString& sentence);  // how it went

 private:
  void write(const std::filesystem::path& file);
  void note_written(const std::filesystem::path& file, std::uint64_t edits,
                    const std::function<void()>& next);

  QWidget& window_;
  std::function<const document::Lesson&()> lesson_;
  std::function<QString()> problem_;
  engine::LessonJobs reading_;
  engine::WorkQueue writing_;
  std::filesystem::path path_;
  std::filesystem::path read_;     // on its way
  std::uint64_t edits_ = 0;        // of all lessons
  std::uint64_t first_edits_ = 0;  // edits_ when the present lesson began
  std::uint64_t saved_edits_ = 0;
  std::function<void()> after_saving_;  // of a save whose file is still asked for
};

}  // namespace tidemark::ui
