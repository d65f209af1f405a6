#include "ui/views/image_overlay.h"

#include <QPainter>
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <limits>
#include <utility>

#include "document/sweep_picture.h"
#include "imaging/resample.h"

namespace tidemark::ui {
namespace {

// With more samples, images would lag behind slices: on larger views one stands for several pixels.
constexpr double kMostSamples = 400000.0;
constexpr int kShades = 256;
// In colour, the lowest values fade away instead of darkening the image below.
constexpr double kFaded = 0.15;

using Shades = std::array<QRgb, kShades>;

Shades shades_of(const engine::ShownImage& image) {
  const bool fades =
      image.colours != engine::ImageColours::grey && image.colours != engine::ImageColours::inverted;
  Shades shades{};
  for (int n = 0; n < kShades; ++n) {
    const double part = static_cast<double>(n) / (kShades - 1);
    const double opacity = image.opacity * (fades ? std::min(1.0, part / kFaded) : 1.0);
    const QRgb colour = colour_of(image.colours, part);
    shades[static_cast<std::size_t>(n)] = qPremultiply(
        qRgba(qRed(colour), qGreen(colour), qBlue(colour), static_cast<int>(std::lround(255.0 * opacity))));
  }
  return shades;
}

// The places of the samples in the patient.
Geometry grid_of(const SliceScreen& screen, QSize size) {
  const double pixels = static_cast<double>(size.width()) * size.height();
  const double step = std::max(1.0, std::sqrt(pixels / kMostSamples));
  Geometry grid;
  grid.size = Index3(std::ceil(size.width() / step), std::ceil(size.height() / step), 1);
  const double across = static_cast<double>(size.width()) / static_cast<double>(grid.size.x);
  const double down = static_cast<double>(size.height()) / static_cast<double>(grid.size.y);
  grid.origin_mm = screen.patient_at({0.5 * across, 0.5 * down});
  const glm::dvec3 right = screen.patient_at({1.5 * across, 0.5 * down}) - grid.origin_mm;
  const glm::dvec3 below = screen.patient_at({0.5 * across, 1.5 * down}) - grid.origin_mm;
  grid.spacing_mm = {glm::length(right), glm::length(below), 1.0};
  grid.direction[0] = glm::normalize(right);
  grid.direction[1] = glm::normalize(below);
  grid.direction[2] = glm::cross(grid.direction[0], grid.direction[1]);
  return grid;
}

bool is_seen(const engine::ShownImage& image) {
  return image.visible && image.opacity > 0.0 && image.image->volume != nullptr;
}

// Null where the slice does not meet the image, or when it was stopped.
QImage draw(const engine::ShownImage& image, const Geometry& grid, const Progress& progress) {
  constexpr float kOutside = std::numeric_limits<float>::quiet_NaN();
  const auto samples = imaging::resample(*image.image->volume, image.image->to_case, grid, image.image->name,
                                         progress, kOutside);
  if (!samples) return {};
  const auto& values = std::get<std::vector<float>>(samples->volume.voxels);
  const Shades shades = shades_of(image);
  QImage picture(static_cast<int>(grid.size.x), static_cast<int>(grid.size.y),
                 QImage::Format_ARGB32_Premultiplied);
  const double width = std::max(image.window.width, 1e-9);
  for (int y = 0; y < picture.height(); ++y) {
    auto* line = reinterpret_cast<QRgb*>(picture.scanLine(y));
    const float* row = values.data() + grid.offset({0, y, 0});
    for (int x = 0; x < picture.width(); ++x) {
      if (std::isnan(row[x])) {
        line[x] = 0;
        continue;
      }
      const double part = (static_cast<double>(row[x]) - image.window.centre) / width + 0.5;
      line[x] = shades[static_cast<std::size_t>(std::clamp(part, 0.0, 1.0) * (kShades - 1) + 0.5)];
    }
  }
  return picture;
}

std::shared_ptr<const renderer::ImagesOver> for_renderer(const QImage& picture) {
  if (picture.isNull()) return nullptr;
  const QImage bytes = picture.convertToFormat(QImage::Format_RGBA8888_Premultiplied);  // 4 a pixel: no gaps
  return std::make_shared<const renderer::ImagesOver>(renderer::ImagesOver{
      bytes.width(), bytes.height(), {bytes.constBits(), bytes.constBits() + bytes.sizeInBytes()}});
}

}  // namespace

QRgb colour_of(engine::ImageColours colours, double part) {
  const auto level = [](double value) {
    return static_cast<int>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
  };
  switch (colours) {
    case engine::ImageColours::inverted:
      return qRgb(level(1.0 - part), level(1.0 - part), level(1.0 - part));
    case engine::ImageColours::hot:  // black, red, yellow, white
      return qRgb(level(3.0 * part), level(3.0 * part - 1.0), level(3.0 * part - 2.0));
    case engine::ImageColours::cool:  // black, blue, cyan, white
      return qRgb(level(3.0 * part - 2.0), level(3.0 * part - 1.0), level(3.0 * part));
    case engine::ImageColours::heat: {
      const auto [red, green, blue] = document::heat_colour(part);
      return qRgb(red, green, blue);
    }
    case engine::ImageColours::grey:
      break;
  }
  return qRgb(level(part), level(part), level(part));
}

ImageOverlay::~ImageOverlay() {
  if (job_) job_->abandon();
}

void ImageOverlay::ask(const std::vector<engine::ShownImage>& images, const renderer::SliceView& slice,
                       const SliceScreen& screen, QSize size) {
  Question question;
  std::copy_if(images.begin(), images.end(), std::back_inserter(question.images), is_seen);
  if (question.images.empty() || size.isEmpty()) return forget();
  question.grid = grid_of(screen, size);
  question.size = size;
  if (question == question_) return;
  question_ = std::move(question);
  slice_ = slice;
  if (!job_) start();
}

void ImageOverlay::forget() {
  if (job_) job_->abandon();
  job_.reset();
  question_ = {};
  newest_.reset();
}

void ImageOverlay::start() {
  job_ = engine::BackgroundJob::start(
      this,
      [this, question = question_, slice = slice_](engine::BackgroundJob& job) {
        Drawn drawn{slice, question.size, {}, nullptr};
        for (const engine::ShownImage& image : question.images) {
          const QImage one = draw(image, question.grid, {nullptr, job.stop()});
          if (one.isNull()) continue;
          if (drawn.picture.isNull()) {
            drawn.picture = one;
          } else {
            QPainter(&drawn.picture).drawImage(0, 0, one);
          }
        }
        drawn.over = for_renderer(drawn.picture);
        job.deliver([this, question, drawn = std::move(drawn)] { take(question, drawn); });
      },
      [this](const Error&) {
        job_.reset();
        question_ = {};  // to be asked again
      });
}

void ImageOverlay::take(const Question& question, Drawn drawn) {
  job_.reset();
  newest_ = std::move(drawn);
  if (question != question_) start();
  emit arrived();
}

}  // namespace tidemark::ui
