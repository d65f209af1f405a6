#include "session/job_progress.h"

#include <QCoreApplication>
#include <chrono>
#include <utility>

#include "session/background_job.h"

namespace tidemark {
namespace {

constexpr std::chrono::milliseconds kBetweenReports{50};

}  // namespace

QString step_text(const char* context, std::string_view step) {
  QString text = QCoreApplication::translate(context, std::string(step).c_str());
  if (!text.isEmpty()) text[0] = text[0].toUpper();
  return text;
}

Progress job_progress(BackgroundJob& job, const char* context,
                      std::function<void(double fraction, const QString& step)> hear) {
  Progress progress;
  progress.stop = job.stop();
  progress.report = [&job, context, hear = std::move(hear), last = std::chrono::steady_clock::time_point()](
                        double fraction, std::string_view step) mutable {
    const auto now = std::chrono::steady_clock::now();
    if (now - last < kBetweenReports) return;
    last = now;
    job.deliver([hear, fraction, text = step_text(context, step)] { hear(fraction, text); });
  };
  return progress;
}

}  // namespace tidemark
