#include "imaging/regions/diameters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numeric>
#include <vector>

namespace tidemark::imaging {
namespace {

// Places are mm along the grid's axes from the centre of its first voxel.
struct Pair {
  glm::dvec3 from{0.0};
  glm::dvec3 to{0.0};
  double length = -1.0;

  void take_longer(glm::dvec3 a, glm::dvec3 b) {
    const double distance = glm::distance(a, b);
    if (distance > length) *this = {a, b, distance};
  }
};

// The first and the last voxel of a row or column; none while first > last.
struct Reach {
  std::int64_t first = std::numeric_limits<std::int64_t>::max();
  std::int64_t last = std::numeric_limits<std::int64_t>::min();

  void add(std::int64_t at) {
    first = std::min(first, at);
    last = std::max(last, at);
  }
};

// The corners of the smallest convex polygon around points of a plane (Andrew's monotone chain).
std::vector<glm::dvec2> convex_hull(std::vector<glm::dvec2> points) {
  const auto before = [](glm::dvec2 a, glm::dvec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); };
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  const auto turns_left = [](glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0.0;
  };
  std::vector<glm::dvec2> hull;
  const auto chain = [&](auto begin, auto end) {
    const std::size_t base = hull.size();
    for (auto point = begin; point != end; ++point) {
      while (hull.size() >= base + 2 && !turns_left(hull[hull.size() - 2], hull.back(), *point))
        hull.pop_back();
      hull.push_back(*point);
    }
    hull.pop_back();  // the other chain begins with it
  };
  chain(points.begin(), points.end());
  chain(points.rbegin(), points.rend());
  return hull;
}

// The corners of a region's slices: what its longest lines end at.
class SliceCorners {
 public:
  SliceCorners(const Region& region, const Geometry& grid);

  [[nodiscard]] Pair longest() const;
  [[nodiscard]] Pair longest_in_slice() const;
  [[nodiscard]] double reach_along(glm::dvec3 direction) const;
  [[nodiscard]] int axis() const { return axis_; }

 private:
  struct Slice {
    std::vector<Reach> rows;     // along u, by v
    std::vector<Reach> columns;  // along v, by u
    std::vector<glm::dvec3> corners;
    std::size_t in_plane = 0;  // the first of `corners`; others lie on faces between slices
    glm::dvec3 low{0.0};       // of `corners`
    glm::dvec3 high{0.0};
  };
  void find_corners(Slice& slice, std::int64_t number) const;
  [[nodiscard]] glm::dvec3 place(glm::dvec2 in_plane, double along) const {
    glm::dvec3 at;
    at[axis_] = along;
    at[u_] = in_plane.x;
    at[v_] = in_plane.y;
    return at;
  }

  const Geometry& grid_;
  int axis_ = 2;  // across the slices
  int u_ = 0;
  int v_ = 1;
  VoxelRange box_;
  std::vector<Slice> slices_;
};

// The axis of the grid that runs most nearly along the patient.
int axial_axis(const Geometry& grid) {
  int axis = 2;
  for (const int other : {0, 1}) {
    if (std::abs(grid.direction[other].z) > std::abs(grid.direction[axis].z)) axis = other;
  }
  return axis;
}

SliceCorners::SliceCorners(const Region& region, const Geometry& grid)
    : grid_(grid), axis_(axial_axis(grid)), u_((axis_ + 1) % 3), v_((axis_ + 2) % 3), box_(region.bounds()) {
  const Index3 size = box_.high - box_.low;
  Slice empty;
  empty.rows.resize(static_cast<std::size_t>(size[v_]));
  empty.columns.resize(static_cast<std::size_t>(size[u_]));
  slices_.assign(static_cast<std::size_t>(size[axis_]), empty);
  region.for_each_run([&](Index3 voxel, std::int64_t length) {
    for (const std::int64_t end = voxel.x + length; voxel.x < end; ++voxel.x) {
      const Index3 at = voxel - box_.low;
      Slice& slice = slices_[static_cast<std::size_t>(at[axis_])];
      slice.rows[static_cast<std::size_t>(at[v_])].add(voxel[u_]);
      slice.columns[static_cast<std::size_t>(at[u_])].add(voxel[v_]);
    }
  });
  for (std::size_t n = 0; n < slices_.size(); ++n)
    find_corners(slices_[n], box_.low[axis_] + static_cast<std::int64_t>(n));
}

// A face between slices that another voxel hides lies between two that end the region: taking all of them
// changes no longest line.
void SliceCorners::find_corners(Slice& slice, std::int64_t number) const {
  const double du = grid_.spacing_mm[u_];
  const double dv = grid_.spacing_mm[v_];
  std::vector<glm::dvec2> faces;
  std::vector<glm::dvec2> centres;
  for (std::size_t n = 0; n < slice.rows.size(); ++n) {
    const Reach& row = slice.rows[n];
    if (row.first > row.last) continue;
    const double v = static_cast<double>(box_.low[v_] + static_cast<std::int64_t>(n)) * dv;
    const double first = static_cast<double>(row.first) * du;
    const double last = static_cast<double>(row.last) * du;
    centres.insert(centres.end(), {{first, v}, {last, v}});
    faces.insert(faces.end(), {{first - 0.5 * du, v}, {last + 0.5 * du, v}});
  }
  for (std::size_t n = 0; n < slice.columns.size(); ++n) {
    const Reach& column = slice.columns[n];
    if (column.first > column.last) continue;
    const double u = static_cast<double>(box_.low[u_] + static_cast<std::int64_t>(n)) * du;
    faces.emplace_back(u, (static_cast<double>(column.first) - 0.5) * dv);
    faces.emplace_back(u, (static_cast<double>(column.last) + 0.5) * dv);
  }
  slice.rows = {};
  slice.columns = {};
  const double spacing = grid_.spacing_mm[axis_];
  const double along = static_cast<double>(number) * spacing;
  for (const glm::dvec2 corner : convex_hull(std::move(faces))) slice.corners.push_back(place(corner, along));
  slice.in_plane = slice.corners.size();
  for (const glm::dvec2 corner : convex_hull(std::move(centres))) {
    slice.corners.push_back(place(corner, along - 0.5 * spacing));
    slice.corners.push_back(place(corner, along + 0.5 * spacing));
  }
  if (slice.corners.empty()) return;
  slice.low = slice.high = slice.corners.front();
  for (const glm::dvec3 corner : slice.corners) {
    slice.low = glm::min(slice.low, corner);
    slice.high = glm::max(slice.high, corner);
  }
}

Pair SliceCorners::longest_in_slice() const {
  Pair longest;
  for (const Slice& slice : slices_) {
    for (std::size_t a = 0; a < slice.in_plane; ++a) {
      for (std::size_t b = a + 1; b < slice.in_plane; ++b)
        longest.take_longer(slice.corners[a], slice.corners[b]);
    }
  }
  return longest;
}

Pair SliceCorners::longest() const {
  Pair longest = longest_in_slice();
  for (std::size_t s = 0; s < slices_.size(); ++s) {
    for (std::size_t t = slices_.size(); t-- > s;) {
      const Slice& slice = slices_[s];
      const Slice& other = slices_[t];
      if (slice.corners.empty() || other.corners.empty()) continue;
      // No two points of the boxes lie farther apart.
      if (glm::length(glm::max(slice.high - other.low, other.high - slice.low)) <= longest.length) continue;
      for (const glm::dvec3 a : slice.corners) {
        for (const glm::dvec3 b : other.corners) longest.take_longer(a, b);
      }
    }
  }
  return longest;
}

double SliceCorners::reach_along(glm::dvec3 direction) const {
  double low = std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::lowest();
  for (const Slice& slice : slices_) {
    for (const glm::dvec3 corner : slice.corners) {
      low = std::min(low, glm::dot(corner, direction));
      high = std::max(high, glm::dot(corner, direction));
    }
  }
  return high - low;
}

// A piece of the border of a slice, between the middles of two faces of a voxel's corner: `along` a line and
// `across` it.
struct BorderPiece {
  glm::dvec2 from{0.0};
  glm::dvec2 to{0.0};
};

// The border of the slice that `line` lies in: x along the line, y across it.
std::vector<BorderPiece> border_along(const Pair& line, const Region& region, const Geometry& grid,
                                      int axis) {
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  const VoxelRange box = region.bounds();
  const glm::dvec3 along = (line.to - line.from) / line.length;
  Index3 voxel(0);
  voxel[axis] = std::llround(line.from[axis] / grid.spacing_mm[axis]);
  const auto place = [&](double at_u, double at_v) {
    const double x = at_u * grid.spacing_mm[u] - line.from[u];
    const double y = at_v * grid.spacing_mm[v] - line.from[v];
    return glm::dvec2(x * along[u] + y * along[v], y * along[u] - x * along[v]);
  };
  std::vector<BorderPiece> border;
  for (std::int64_t at_v = box.low[v] - 1; at_v < box.high[v]; ++at_v) {
    for (std::int64_t at_u = box.low[u] - 1; at_u < box.high[u]; ++at_u) {
      const auto inside = [&](int du, int dv) {
        voxel[u] = at_u + du;
        voxel[v] = at_v + dv;
        return region.contains(voxel);
      };
      const std::array<bool, 4> corner{inside(0, 0), inside(1, 0), inside(1, 1), inside(0, 1)};
      const double x = static_cast<double>(at_u);
      const double y = static_cast<double>(at_v);
      const std::array<glm::dvec2, 4> middle{place(x + 0.5, y), place(x + 1.0, y + 0.5),
                                             place(x + 0.5, y + 1.0), place(x, y + 0.5)};
      // Around each corner that differs from both neighbours; else between the two sides that are crossed.
      std::vector<std::size_t> crossed;
      for (std::size_t side = 0; side < 4; ++side) {
        if (corner[side] != corner[(side + 1) % 4]) crossed.push_back(side);
      }
      if (crossed.size() == 2) border.push_back({middle[crossed[0]], middle[crossed[1]]});
      if (crossed.size() == 4) {
        const std::size_t first = corner[0] ? 0 : 1;
        for (const std::size_t side : {first, first + 2})
          border.push_back({middle[(side + 3) % 4], middle[side]});
      }
    }
  }
  return border;
}

// The longest line at right angles to `line`, in its slice, from border to border. Between two ends of border
// pieces its length changes linearly: it is longest at one of them.
Pair longest_across(const Pair& line, const Region& region, const Geometry& grid, int axis) {
  std::vector<BorderPiece> border = border_along(line, region, grid, axis);
  for (BorderPiece& piece : border) {
    if (piece.from.x > piece.to.x) std::swap(piece.from, piece.to);
  }
  std::vector<double> places;
  for (const BorderPiece& piece : border) places.push_back(piece.from.x);
  for (const BorderPiece& piece : border) places.push_back(piece.to.x);
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  double at = 0.0;
  glm::dvec2 ends(0.0);
  for (const double x : places) {
    double low = std::numeric_limits<double>::max();
    double high = std::numeric_limits<double>::lowest();
    for (const BorderPiece& piece : border) {
      if (x < piece.from.x || x > piece.to.x) continue;
      const double width = piece.to.x - piece.from.x;
      const double share = width > 0.0 ? (x - piece.from.x) / width : 0.0;
      const double y = glm::mix(piece.from.y, piece.to.y, share);
      low = std::min({low, y, width > 0.0 ? y : piece.to.y});
      high = std::max({high, y, width > 0.0 ? y : piece.to.y});
    }
    if (high - low <= ends.y - ends.x) continue;
    at = x;
    ends = {low, high};
  }
  const glm::dvec3 along = (line.to - line.from) / line.length;
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  glm::dvec3 across(0.0);
  across[u] = -along[v];
  across[v] = along[u];
  const glm::dvec3 foot = line.from + at * along;
  return {foot + ends.x * across, foot + ends.y * across, ends.y - ends.x};
}

struct VoxelSpread {
  glm::dvec3 mean{0.0};
  glm::dmat3 covariance{0.0};
};

// Of the voxels' centres.
VoxelSpread spread_of(const Region& region, const Geometry& grid) {
  const glm::dvec3 base = glm::dvec3(region.bounds().low) * grid.spacing_mm;
  double count = 0.0;
  glm::dvec3 sum(0.0);
  glm::dmat3 products(0.0);
  region.for_each_run([&](Index3 voxel, std::int64_t length) {
    const auto n = static_cast<double>(length);
    const double h = grid.spacing_mm.x;
    const glm::dvec3 middle =
        glm::dvec3(voxel) * grid.spacing_mm + glm::dvec3(0.5 * (n - 1.0) * h, 0.0, 0.0) - base;
    count += n;
    sum += n * middle;
    products += n * glm::outerProduct(middle, middle);
    products[0][0] += h * h * n * (n * n - 1.0) / 12.0;  // of the run around its middle
  });
  const glm::dvec3 mean = sum / count;
  return {mean + base, products / count - glm::outerProduct(mean, mean)};
}

// The eigenvectors of a symmetric matrix, that of the largest eigenvalue first (Jacobi's rotations; a 3 x 3
// matrix needs a few rounds).
glm::dmat3 main_axes_of(glm::dmat3 matrix) {
  constexpr int kRounds = 20;
  glm::dmat3 vectors(1.0);
  for (int round = 0; round < kRounds; ++round) {
    for (const auto& [p, q] : {std::pair(0, 1), {0, 2}, {1, 2}}) {
      if (matrix[p][q] == 0.0) continue;
      const double theta = 0.5 * std::atan2(2.0 * matrix[p][q], matrix[q][q] - matrix[p][p]);
      glm::dmat3 turn(1.0);
      turn[p][p] = turn[q][q] = std::cos(theta);
      turn[p][q] = -std::sin(theta);
      turn[q][p] = std::sin(theta);
      matrix = glm::transpose(turn) * matrix * turn;
      matrix[p][q] = matrix[q][p] = 0.0;
      vectors = vectors * turn;
    }
  }
  std::array<int, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return matrix[a][a] > matrix[b][b]; });
  return {vectors[order[0]], vectors[order[1]], vectors[order[2]]};
}

}  // namespace

std::optional<Diameters> diameters_of(const Region& region, const Geometry& grid) {
  if (region.empty()) return std::nullopt;
  const SliceCorners slices(region, grid);
  const auto in_patient = [&](glm::dvec3 place) { return grid.to_patient(place / grid.spacing_mm); };
  const auto chord = [&](const Pair& pair) { return Chord{in_patient(pair.from), in_patient(pair.to)}; };
  const Pair in_slice = slices.longest_in_slice();
  const VoxelSpread spread = spread_of(region, grid);
  const glm::dmat3 axes = main_axes_of(spread.covariance);
  Diameters diameters;
  diameters.longest = chord(slices.longest());
  diameters.in_slice = chord(in_slice);
  diameters.across = chord(longest_across(in_slice, region, grid, slices.axis()));
  diameters.centre_mm = in_patient(spread.mean);
  diameters.main_axes = grid.direction * axes;
  for (int axis = 0; axis < 3; ++axis) diameters.reach_mm[axis] = slices.reach_along(axes[axis]);
  return diameters;
}

}  // namespace tidemark::imaging
