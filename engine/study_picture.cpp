#include "engine/study_picture.h"

#include <QTransform>
#include <algorithm>
#include <cmath>

namespace tidemark::engine {
namespace {

QImage grey_picture(const Volume& slice, const WindowLevel& window) {
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

QImage picture_of_slice(const Volume& slice, const WindowLevel& window, int pixels) {
  const QImage picture = grey_picture(slice, window);
  if (picture.isNull()) return {};
  return as_radiologists_look(in_proportion(picture, slice.geometry, pixels), slice.geometry);
}

QImage picture_of_volume(const Volume& volume, const WindowLevel& window, std::int64_t k, int pixels) {
  const Index3 size = volume.geometry.size;
  if (k < 0 || k >= size.z) return {};
  Volume slice;
  slice.geometry = volume.geometry;
  slice.geometry.size.z = 1;
  std::vector<float> values;
  values.reserve(static_cast<std::size_t>(size.x * size.y));
  for (std::int64_t offset = 0; offset < size.x * size.y; ++offset)
    values.push_back(volume.value(k * size.x * size.y + offset));
  slice.voxels = std::move(values);
  return picture_of_slice(slice, window, pixels);
}

}  // namespace tidemark::engine
