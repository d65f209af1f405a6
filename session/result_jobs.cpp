#include "session/result_jobs.h"

#include <QCoreApplication>

#include "session/background_job.h"
#include "session/job_progress.h"
#include "study/result_files.h"

namespace tidemark {
namespace {

// Steps as the folders below name them, for translators.
[[maybe_unused]] constexpr const char* kSteps[] = {
    QT_TRANSLATE_NOOP("tidemark::ResultStep", "writing segments"),
    QT_TRANSLATE_NOOP("tidemark::ResultStep", "writing contours"),
    QT_TRANSLATE_NOOP("tidemark::ResultStep", "writing the level set"),
    QT_TRANSLATE_NOOP("tidemark::ResultStep", "reading labels"),
    QT_TRANSLATE_NOOP("tidemark::ResultStep", "reading the volume"),
};

}  // namespace

ResultJobs::~ResultJobs() {
  if (job_) job_->abandon();
}

// Calls work(progress) on a thread and deliver(result) here.
template <class Work, class Deliver>
void ResultJobs::run(Work work, Deliver deliver) {
  if (job_) job_->abandon();
  job_ = BackgroundJob::start(this, [this, work, deliver](BackgroundJob& job) {
    const Progress progress =
        job_progress(job, "tidemark::ResultStep",
                     [this](double fraction, const QString& step) { emit progressed(fraction, step); });
    const auto result = std::make_shared<decltype(work(progress))>(without_exceptions(work, progress));
    job.deliver([this, deliver, result] {
      job_.reset();
      if (*result) return deliver(*result);
      if (result->error().kind == ErrorKind::cancelled) return emit cancelled();
      emit failed(QString::fromStdString(result->error().message));
    });
  });
}

void ResultJobs::write(std::function<Status(const Progress&)> work) {
  run(std::move(work), [this](const Status&) { emit written(); });
}

void ResultJobs::read_labels(const std::filesystem::path& file, const Geometry& grid, bool only_results) {
  using Found = std::shared_ptr<const Segments>;  // null: no result
  run(
      [=](const Progress& progress) -> Result<Found> {
        if (only_results && !result_form_of(file)) return Found();
        auto segments = tidemark::read_labels(file, grid, progress);
        if (!segments) return pass_on(segments);
        if (progress.cancelled()) return cancelled_error();
        return std::make_shared<const Segments>(std::move(*segments));
      },
      [this](const Result<Found>& found) {
        if (!*found) return emit no_result();
        emit labels_read(*found);
      });
}

void ResultJobs::cancel() {
  if (job_) job_->request_stop();
}

}  // namespace tidemark
