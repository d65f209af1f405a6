// The reading and carrying out of lessons, beside the user interface.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "document/lesson.h"
#include "document/lesson_run.h"
#include "engine/job_runner.h"

namespace tidemark::engine {

class LessonJobs : public JobRunner {
  Q_OBJECT
 public:
  explicit LessonJobs(QObject* parent = nullptr);

  // Each ends with the signal of that name, or with failed() or cancelled().
  void load(const std::filesystem::path& file);
  // By the host executor. `folder` holds the lesson's file.
  void carry_out(const document::Lesson& lesson, const std::filesystem::path& folder);
  // The parameters that suit a phantom, as imaging::named_phantom() takes it.
  void suit(const std::string& phantom);

  void cancel() { give_up(); }

 signals:
  void loaded(std::shared_ptr<const tidemark::document::Lesson> lesson);
  // One outcome a part.
  void carried_out(const std::vector<tidemark::document::LessonOutcome>& outcomes);
  void suited(const tidemark::solver::Parameters& parameters);
};

}  // namespace tidemark::engine
