#include "imaging/results/polygon_fill.h"

#include <algorithm>
#include <cmath>

namespace tidemark {
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
  // Where edges cross the rows of voxel centres; an edge owns its lower end, not its upper one.
  std::vector<std::vector<double>> crossings(static_cast<std::size_t>(rows));
  bool beyond = false;
  for (std::size_t n = 0; n < polygon.size(); ++n) {
    glm::dvec2 a = polygon[n];
    glm::dvec2 b = polygon[(n + 1) % polygon.size()];
    beyond = beyond || is_beyond(a, columns, rows);
    if (a.y > b.y) std::swap(a, b);
    const std::int64_t end = first_from(b.y, rows);
    for (std::int64_t j = first_from(a.y, rows); j < end; ++j) {
      const double along = (static_cast<double>(j) - a.y) / (b.y - a.y);
      crossings[static_cast<std::size_t>(j)].push_back(a.x + along * (b.x - a.x));
    }
  }
  for (std::int64_t j = 0; j < rows; ++j) {
    std::vector<double>& row = crossings[static_cast<std::size_t>(j)];
    std::sort(row.begin(), row.end());
    for (std::size_t n = 0; n + 1 < row.size(); n += 2) {
      const std::int64_t end = first_from(row[n + 1], columns);
      for (std::int64_t i = first_from(row[n], columns); i < end; ++i) {
        slice[static_cast<std::size_t>(j * columns + i)] ^= 1;
      }
    }
  }
  return beyond;
}

}  // namespace tidemark
