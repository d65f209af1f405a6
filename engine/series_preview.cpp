#include "engine/series_preview.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <mutex>

#include "engine/background_job.h"
#include "imaging/load_study.h"
#include "renderer/sheet.h"

namespace tidemark {
namespace {

constexpr std::int64_t kMostFileVoxels = 64'000'000;  // of volume files, which are read whole

QImage grey_picture(const Volume& slice) {
  const WindowLevel window = window_of(slice);
  const Index3 size = slice.geometry.size;
  QImage picture(static_cast<int>(size.x), static_cast<int>(size.y), QImage::Format_Grayscale8);
  if (picture.isNull()) return picture;
  for (std::int64_t j = 0; j < size.y; ++j) {
    uchar* line = picture.scanLine(static_cast<int>(j));
    for (std::int64_t i = 0; i < size.x; ++i) {
      const double value = slice.value(Index3(i, j, 0));
      const double share = (value - window.centre) / window.width + 0.5;
      line[i] = static_cast<uchar>(std::lround(255.0 * std::clamp(share, 0.0, 1.0)));
    }
  }
  return picture;
}

// The patient's axis (0 left, 1 posterior, 2 head) along which a grid's axis runs most.
int main_axis(const glm::dvec3& direction) {
  int axis = 0;
  for (int other = 1; other < 3; ++other) {
    if (std::abs(direction[other]) > std::abs(direction[axis])) axis = other;
  }
  return axis;
}

// The patient's left (or, in sagittal slices, back) to the right; the front (or the head) up.
QImage as_radiologists_look(QImage picture, const Geometry& geometry) {
  glm::dvec3 right = geometry.direction[0];
  glm::dvec3 down = geometry.direction[1];
  if (main_axis(right) > main_axis(down)) {
    picture = picture.transformed(QTransform(0, 1, 1, 0, 0, 0));  // rows become columns
    std::swap(right, down);
  }
  const int down_axis = main_axis(down);
  const bool flip_right = right[main_axis(right)] < 0.0;
  const bool flip_down = down_axis == 2 ? down[down_axis] > 0.0 : down[down_axis] < 0.0;
  return picture.mirrored(flip_right, flip_down);
}

// With the size in pixels as in mm, within a square of `pixels`.
QImage in_proportion(const QImage& picture, const Geometry& geometry, int pixels) {
  const double width = static_cast<double>(geometry.size.x) * geometry.spacing_mm.x;
  const double height = static_cast<double>(geometry.size.y) * geometry.spacing_mm.y;
  const double scale = pixels / std::max(width, height);
  const auto extent = [&](double mm) { return std::max(1, static_cast<int>(std::lround(mm * scale))); };
  return picture.scaled(extent(width), extent(height), Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
}

}  // namespace

QImage middle_slice_picture(const Series& series, int pixels, const Progress& progress) {
  const bool is_file = series.transfer_syntaxes.empty();
  if (!series.loadable || (is_file && series.geometry.voxel_count() > kMostFileVoxels)) return {};
  const auto slice = load_slice(series, series.geometry.size.z / 2, progress);
  if (!slice) return {};
  const QImage picture = grey_picture(*slice);
  if (picture.isNull()) return {};
  return as_radiologists_look(in_proportion(picture, slice->geometry, pixels), slice->geometry);
}

struct SeriesPreviews::Waiting {
  struct Request {
    int key;
    Series series;
    int pixels;
  };
  std::mutex mutex;
  std::deque<Request> requests;
};

SeriesPreviews::SeriesPreviews(QObject* parent) : QObject(parent), waiting_(std::make_shared<Waiting>()) {}

SeriesPreviews::~SeriesPreviews() {
  if (job_) job_->abandon();
}

void SeriesPreviews::request(int key, const Series& series, int pixels) {
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

}  // namespace tidemark
