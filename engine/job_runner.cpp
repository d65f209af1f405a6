#include "engine/job_runner.h"

#include <mutex>
#include <string>
#include <string_view>

#include "engine/background_job.h"
#include "engine/message_text.h"

namespace tidemark::engine {
namespace {

// What work says on its way: the last word counts, and at most one is waiting to be heard.
struct LastWord {
  std::mutex mutex;
  double fraction = 0.0;
  std::string step;
  bool waits = false;
};

// With a capital letter.
QString step_text(const std::string& step) {
  QString text = message_text(step);
  if (!text.isEmpty()) text[0] = text[0].toUpper();
  return text;
}

// `hear` is called on the receiver's thread. The job must outlive the work.
Progress progress_of(BackgroundJob& job, std::function<void(double fraction, const QString& step)> hear) {
  const auto last = std::make_shared<LastWord>();
  const auto hear_last = [last, hear = std::move(hear)] {
    std::unique_lock lock(last->mutex);
    last->waits = false;
    const double fraction = last->fraction;
    const std::string step = last->step;
    lock.unlock();
    hear(fraction, step_text(step));
  };
  Progress progress;
  progress.stop = job.stop();
  progress.report = [&job, last, hear_last](double fraction, std::string_view step) {
    const std::lock_guard lock(last->mutex);
    last->fraction = fraction;
    last->step = step;
    if (!std::exchange(last->waits, true)) job.deliver(hear_last);
  };
  return progress;
}

}  // namespace

JobRunner::~JobRunner() {
  if (job_) job_->abandon();
}

void JobRunner::start(std::function<Ending(const Progress&)> work) {
  if (job_) job_->abandon();
  job_ = BackgroundJob::start(
      this,
      [this, work = std::move(work)](BackgroundJob& job) {
        const Progress progress = progress_of(
            job, [this](double fraction, const QString& step) { emit progressed(fraction, step); });
        job.deliver([this, ending = work(progress)] {
          job_.reset();
          ending();
        });
      },
      [this](const Error& error) {
        job_.reset();
        end_by(error);
      });
}

void JobRunner::end_by(const Error& error) {
  if (error.kind == ErrorKind::cancelled) return emit cancelled();
  emit failed(message_text(error));
}

void JobRunner::give_up() {
  if (!job_) return;
  job_->abandon();
  job_.reset();
  emit cancelled();
}

void JobRunner::ask_to_stop() {
  if (job_) job_->request_stop();
}

}  // namespace tidemark::engine
