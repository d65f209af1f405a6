#include "imaging/results/polygon_fill.h"

#include <algorithm>
#include <cmath>

namespace tidemark::imaging {
namespace {

// The first voxel whose centre is at or after `at`, within [0, count].
std::int64_t first_from(double at, std::int64_t count) {
  return static_cast<std::int64_t>(std::ceil(std::clamp(at, 0.0, static_cast<double>(count))));
}

// Whether a point lies beyond the outer faces of the border's voxels; files round.
bool is_beyond(glm::dvec2 point, std::int64_t columns, std::int64_t rows) {
  constexpr double kFace = 0.6;
  return point.x < -kFace || point.y < -kFace || point.x > static_cast<double>(columns - 1) + kFace ||
         point.y > static_cast<double>(rows - 1) + kFace;
}

}  // namespace

bool flip_inside(std::span<const glm::dvec2> polygon, std::int64_t columns, std::int64_t rows,
                 std::vector<std::uint8_t>& slice) {
  const auto [lowest, highest] = std::minmax_element(polygon.begin(), polygon.end(),
                                                     [](glm::dvec2 a, glm::dvec2 b) { return a.y < b.y; });
  const std::int64_t first_row = first_from(lowest->y, rows);
  const std::int64_t row_end = first_from(highest->y, rows);
  // Where an edge crosses a row of voxel centres, all that follows in the row is turned round. An edge owns
  // its lower end, not its upper one, so that a row is crossed an even number of times.
  const std::int64_t stride = columns + 1;
  std::vector<bool> turns(static_cast<std::size_t>((row_end - first_row) * stride));
  bool beyond = false;
  for (std::size_t n = 0; n < polygon.size(); ++n) {
    glm::dvec2 a = polygon[n];
    glm::dvec2 b = polygon[(n + 1) % polygon.size()];
    beyond = beyond || is_beyond(a, columns, rows);
    if (a.y > b.y) std::swap(a, b);
    const std::int64_t end = first_from(b.y, rows);
    for (std::int64_t j = first_from(a.y, rows); j < end; ++j) {
      const double along = (static_cast<double>(j) - a.y) / (b.y - a.y);
      const std::int64_t i = first_from(a.x + along * (b.x - a.x), columns);
      turns[static_cast<std::size_t>((j - first_row) * stride + i)].flip();
    }
  }
  for (std::int64_t j = first_row; j < row_end; ++j) {
    bool is_inside = false;
    for (std::int64_t i = 0; i < columns; ++i) {
      is_inside = is_inside != turns[static_cast<std::size_t>((j - first_row) * stride + i)];
      slice[static_cast<std::size_t>(j * columns + i)] ^= static_cast<std::uint8_t>(is_inside);
    }
  }
  return beyond;
}

}  // namespace tidemark::imaging
