#include "engine/series_preview.h"

#include <deque>
#include <mutex>

#include "engine/background_job.h"
#include "engine/study_picture.h"
#include "imaging/load_study.h"
#include "renderer/sheet.h"

namespace tidemark::engine {
namespace {

constexpr std::int64_t kMostFileVoxels = 64'000'000;  // of volume files, which are read whole

}  // namespace

QImage middle_slice_picture(const imaging::Series& series, int pixels, const Progress& progress) {
  const bool is_file = series.transfer_syntaxes.empty();
  if (!series.loadable || (is_file && series.geometry.voxel_count() > kMostFileVoxels)) return {};
  const auto slice = imaging::load_slice(series, series.geometry.size.z / 2, progress);
  if (!slice) return {};
  return picture_of_slice(*slice, renderer::window_of(*slice), pixels);
}

struct SeriesPreviews::Waiting {
  struct Request {
    int key;
    imaging::Series series;
    int pixels;
  };
  std::mutex mutex;
  std::deque<Request> requests;
};

SeriesPreviews::SeriesPreviews(QObject* parent) : QObject(parent), waiting_(std::make_shared<Waiting>()) {}

SeriesPreviews::~SeriesPreviews() {
  if (job_) job_->abandon();
}

void SeriesPreviews::request(int key, const imaging::Series& series, int pixels) {
  const std::lock_guard lock(waiting_->mutex);
  waiting_->requests.push_back({key, series, pixels});
  if (!job_) start();
}

void SeriesPreviews::forget() {
  waiting_ = std::make_shared<Waiting>();  // the thread keeps the one it knows
  if (job_) job_->abandon();
  job_.reset();
}

void SeriesPreviews::start() {
  job_ = BackgroundJob::start(
      this,
      [this, waiting = waiting_](BackgroundJob& job) {
        Progress progress;
        progress.stop = job.stop();
        while (!progress.cancelled()) {
          std::unique_lock lock(waiting->mutex);
          if (waiting->requests.empty()) break;
          const Waiting::Request next = std::move(waiting->requests.front());
          waiting->requests.pop_front();
          lock.unlock();
          const QImage picture = middle_slice_picture(next.series, next.pixels, progress);
          job.deliver([this, key = next.key, picture] { emit made(key, picture); });
        }
        job.deliver([this] { go_on(); });
      },
      [this](const Error&) { go_on(); });  // without the picture that could not be made
}

// Some may have been asked for just when the thread went.
void SeriesPreviews::go_on() {
  job_.reset();
  const std::lock_guard lock(waiting_->mutex);
  if (!waiting_->requests.empty()) start();
}

}  // namespace tidemark::engine
