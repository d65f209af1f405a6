#include "session/result_jobs.h"

#include <QCoreApplication>
#include <chrono>
#include <new>

#include "session/background_job.h"
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
constexpr std::chrono::milliseconds kBetweenReports{50};

// In the user's language, with a capital letter.
QString step_text(std::string_view step) {
  QString text = QCoreApplication::translate("tidemark::ResultStep", std::string(step).c_str());
  if (!text.isEmpty()) text[0] = text[0].toUpper();
  return text;
}

template <class Work>
auto without_exceptions(const Work& work, const Progress& progress) -> decltype(work(progress)) {
  try {
    return work(progress);
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::capability, "there is not enough memory");
  } catch (const std::exception& error) {
    return fail(ErrorKind::internal, "{}", error.what());
  }
}

}  // namespace

ResultJobs::~ResultJobs() {
  if (job_) job_->abandon();
}

// Calls work(progress) on a thread and deliver(result) here.
template <class Work, class Deliver>
void ResultJobs::run(Work work, Deliver deliver) {
  if (job_) job_->abandon();
  job_ = BackgroundJob::start(this, [this, work, deliver](BackgroundJob& job) {
    Progress progress;
    progress.stop = job.stop();
    progress.report = [this, &job, last = std::chrono::steady_clock::time_point()](
                          double fraction, std::string_view step) mutable {
      const auto now = std::chrono::steady_clock::now();
      if (now - last < kBetweenReports) return;
      last = now;
      job.deliver([this, fraction, text = step_text(step)] { emit progressed(fraction, text); });
    };
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
