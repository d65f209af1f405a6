// A ball of voxels on a grid, row by row.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/geometry.h"

namespace tidemark::imaging {

// A row of voxels of a ball: its place from the centre, and how far it reaches along i on either side.
struct BallRow {
  std::int64_t j = 0;
  std::int64_t k = 0;
  std::int64_t half = 0;
};

struct Ball {
  Index3 reach{0};            // voxels
  std::vector<BallRow> rows;  // the shortest first
};

// The voxels whose centre is at most so far from that of the middle one, as far as a grid is large.
inline Ball ball_of(const Geometry& grid, double mm) {
  constexpr double kRounding = 1e-9;  // a centre at just that distance counts
  const double radius = mm * (1.0 + kRounding);
  Ball ball;
  for (int axis = 0; axis < 3; ++axis) {
    const auto voxels = static_cast<std::int64_t>(radius / grid.spacing_mm[axis]);
    ball.reach[axis] = std::min(voxels, grid.size[axis] - 1);
  }
  for (std::int64_t k = -ball.reach.z; k <= ball.reach.z; ++k) {
    for (std::int64_t j = -ball.reach.y; j <= ball.reach.y; ++j) {
      const double y = static_cast<double>(j) * grid.spacing_mm.y;
      const double z = static_cast<double>(k) * grid.spacing_mm.z;
      const double left = radius * radius - y * y - z * z;
      if (left < 0.0) continue;
      const auto half = static_cast<std::int64_t>(std::sqrt(left) / grid.spacing_mm.x);
      ball.rows.push_back({j, k, std::min(half, grid.size.x - 1)});
    }
  }
  std::stable_sort(ball.rows.begin(), ball.rows.end(),
                   [](const BallRow& a, const BallRow& b) { return a.half < b.half; });
  return ball;
}

}  // namespace tidemark::imaging
