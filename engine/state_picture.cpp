#include "engine/state_picture.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/paging/page_rows.h"
#include "engine/study_picture.h"

namespace tidemark::engine {
namespace {

constexpr double kMargin = 0.4;     // around the surface, as a part of its width
constexpr double kLeastPart = 0.4;  // of the slice is seen: what grows is seen to grow
constexpr QRgb kOutline = qRgb(255, 214, 0);

// Calls visit(x, y, z) for every voxel inside.
template <class Visit>
void for_each_inside(const solver::Field& phi, const Visit& visit) {
  const PageLayout& layout = phi.layout;
  for (std::int64_t page = 0; page < layout.page_count(); ++page) {
    if (phi.pages.kind(page) == solver::Field::Kind::outside) continue;
    const float* const values = phi.pages.values(page);
    for_each_row(phi.geometry, layout, page,
                 [&](std::int64_t offset, std::int64_t length, std::int64_t index) {
                   const Index3 first = phi.geometry.voxel_at(offset);
                   for (std::int64_t i = 0; i < length; ++i) {
                     if (values == nullptr || values[index + i] > 0.0F) visit(first.x + i, first.y, first.z);
                   }
                 });
  }
}

std::int64_t fullest_slice(const solver::Field& phi) {
  std::vector<std::int64_t> inside(static_cast<std::size_t>(phi.geometry.size.z));
  for_each_inside(phi,
                  [&](std::int64_t, std::int64_t, std::int64_t z) { ++inside[static_cast<std::size_t>(z)]; });
  const auto most = std::max_element(inside.begin(), inside.end());
  return most == inside.end() || *most == 0 ? -1 : most - inside.begin();
}

// A part of a slice.
struct Part {
  Index3 first;  // its z: the slice
  Index3 size;   // z = 1
};

// A square in mm around what is inside in the slice, cut at the slice's border.
Part part_around(const solver::Field& phi, std::int64_t slice) {
  const Geometry& geometry = phi.geometry;
  Index3 low = geometry.size;
  Index3 high(-1);
  for_each_inside(phi, [&](std::int64_t x, std::int64_t y, std::int64_t z) {
    if (z != slice) return;
    low = glm::min(low, Index3(x, y, z));
    high = glm::max(high, Index3(x, y, z));
  });
  double side_mm = 0.0;
  for (int axis = 0; axis < 2; ++axis) {
    const double spacing = geometry.spacing_mm[axis];
    const auto width = static_cast<double>(high[axis] - low[axis] + 1);
    side_mm = std::max({side_mm, width * spacing * (1.0 + 2.0 * kMargin),
                        kLeastPart * static_cast<double>(geometry.size[axis]) * spacing});
  }
  Part part{{0, 0, slice}, {1, 1, 1}};
  for (int axis = 0; axis < 2; ++axis) {
    const auto side =
        std::clamp<std::int64_t>(std::llround(side_mm / geometry.spacing_mm[axis]), 1, geometry.size[axis]);
    part.size[axis] = side;
    part.first[axis] =
        std::clamp<std::int64_t>((low[axis] + high[axis] + 1 - side) / 2, 0, geometry.size[axis] - side);
  }
  return part;
}

// The values of a part, by a function of the voxel.
template <class Value>
Volume slice_of(const Geometry& geometry, const Part& part, const Value& value) {
  Volume slice;
  slice.geometry = geometry;
  slice.geometry.size = part.size;
  std::vector<float> values;
  values.reserve(static_cast<std::size_t>(part.size.x * part.size.y));
  for (std::int64_t y = 0; y < part.size.y; ++y) {
    for (std::int64_t x = 0; x < part.size.x; ++x) values.push_back(value(part.first + Index3(x, y, 0)));
  }
  slice.voxels = std::move(values);
  return slice;
}

// Where the level, as grey, goes through the middle: the inner border of what is inside, two pixels wide.
void draw_outline(const QImage& level, QImage& picture) {
  const auto inside = [&](int x, int y) { return level.valid(x, y) && qGray(level.pixel(x, y)) > 127; };
  const auto at_border = [&](int x, int y) {
    for (const int away : {1, 2}) {
      if (!(inside(x - away, y) && inside(x + away, y) && inside(x, y - away) && inside(x, y + away)))
        return true;
    }
    return false;
  };
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      if (inside(x, y) && at_border(x, y)) picture.setPixel(x, y, kOutline);
    }
  }
}

}  // namespace

QImage picture_of_state(const Volume& volume, const solver::Field& phi, const WindowLevel& window,
                        int pixels) {
  const std::int64_t slice = fullest_slice(phi);
  if (slice < 0) return {};
  const Part part = part_around(phi, slice);
  const Volume values = slice_of(volume.geometry, part, [&](Index3 voxel) { return volume.value(voxel); });
  const Volume levels = slice_of(volume.geometry, part, [&](Index3 voxel) { return phi.at(voxel); });
  QImage picture = picture_of_slice(values, window, pixels).convertToFormat(QImage::Format_RGB32);
  if (picture.isNull()) return {};
  draw_outline(picture_of_slice(levels, {0.0, 2.0 * phi.band}, pixels), picture);
  return picture;
}

}  // namespace tidemark::engine
