#include "engine/job_runner.h"

#include <QCoreApplication>
#include <mutex>
#include <string>
#include <string_view>

#include "engine/background_job.h"

namespace tidemark::engine {
namespace {

// What work says on its way: the last word counts, and at most one is waiting to be heard.
struct LastWord {
  std::mutex mutex;
  double fraction = 0.0;
  std::string step;
  bool waits = false;
};

// A step as the folders below name it, in the user's language, with a capital letter.
QString step_text(const char* context, const std::string& step) {
  QString text = QCoreApplication::translate(context, step.c_str());
  if (!text.isEmpty()) text[0] = text[0].toUpper();
  return text;
}

// `hear` is called on the receiver's thread. The job must outlive the work.
Progress progress_of(BackgroundJob& job, const char* context,
                     std::function<void(double fraction, const QString& step)> hear) {
  const auto last = std::make_shared<LastWord>();
  const auto hear_last = [last, context, hear = std::move(hear)] {
    std::unique_lock lock(last->mutex);
    last->waits = false;
    const double fraction = last->fraction;
    const std::string step = last->step;
    lock.unlock();
    hear(fraction, step_text(context, step));
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
      [this, steps = steps_, work = std::move(work)](BackgroundJob& job) {
        const Progress progress = progress_of(
            job, steps, [this](double fraction, const QString& step) { emit progressed(fraction, step); });
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
  emit failed(QString::fromStdString(error.message));
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
