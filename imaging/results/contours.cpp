#include "imaging/results/contours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <utility>

namespace tidemark::imaging {
namespace {

// Contours keep this far from voxel centres (in voxels), so that rounded coordinates leave every centre on
// its side.
constexpr double kLeastDistance = 1.0 / 64.0;

// The values of one slice, with a margin of one voxel outside.
class PaddedSlice {
 public:
  PaddedSlice(std::int64_t columns, std::int64_t rows,
              const std::function<double(std::int64_t, std::int64_t)>& value)
      : columns_(columns + 2), rows_(rows + 2), values_(static_cast<std::size_t>(columns_ * rows_)) {
    for (std::int64_t j = -1; j <= rows; ++j) {
      for (std::int64_t i = -1; i <= columns; ++i) {
        const std::int64_t inner_i = std::clamp<std::int64_t>(i, 0, columns - 1);
        const std::int64_t inner_j = std::clamp<std::int64_t>(j, 0, rows - 1);
        const double v = value(inner_i, inner_j);
        // With the opposite value, linear interpolation crosses zero half way.
        values_[index(i, j)] = inner_i == i && inner_j == j ? v : -std::abs(v);
      }
    }
  }
  [[nodiscard]] double at(std::int64_t i, std::int64_t j) const { return values_[index(i, j)]; }

  // A number for the edge from (i, j) to the next voxel along i or along j.
  [[nodiscard]] std::int64_t edge(std::int64_t i, std::int64_t j, bool along_j) const {
    return 2 * static_cast<std::int64_t>(index(i, j)) + (along_j ? 1 : 0);
  }
  // Where the sign changes on it.
  [[nodiscard]] glm::dvec2 crossing(std::int64_t edge) const {
    const std::int64_t i = edge / 2 % columns_ - 1;
    const std::int64_t j = edge / 2 / columns_ - 1;
    const bool along_j = edge % 2 == 1;
    const double a = at(i, j);
    const double b = along_j ? at(i, j + 1) : at(i + 1, j);
    const double t = std::clamp(a / (a - b), kLeastDistance, 1.0 - kLeastDistance);
    return {static_cast<double>(i) + (along_j ? 0.0 : t), static_cast<double>(j) + (along_j ? t : 0.0)};
  }

 private:
  [[nodiscard]] std::size_t index(std::int64_t i, std::int64_t j) const {
    return static_cast<std::size_t>((j + 1) * columns_ + i + 1);
  }

  std::int64_t columns_;
  std::int64_t rows_;
  std::vector<double> values_;
};

// For each edge that a contour crosses, the edge that it crosses next.
using Links = std::unordered_map<std::int64_t, std::int64_t>;

// The piece or pieces of contour in the cell between (i, j) and (i + 1, j + 1). Round the cell, contours go
// from an edge where the inside ends to one where it begins, with the inside always on the same hand.
void link_cell(const PaddedSlice& slice, std::int64_t i, std::int64_t j, Links& links) {
  const std::array<double, 4> corner{slice.at(i, j), slice.at(i + 1, j), slice.at(i + 1, j + 1),
                                     slice.at(i, j + 1)};
  const auto inside = [&](std::size_t c) { return corner[c % 4] > 0.0; };
  const int count = inside(0) + inside(1) + inside(2) + inside(3);
  if (count == 0 || count == 4) return;
  const std::array<std::int64_t, 4> edges{slice.edge(i, j, false), slice.edge(i + 1, j, true),
                                          slice.edge(i, j + 1, false), slice.edge(i, j, true)};
  // Where opposite corners are inside, the value in the middle says whether they are joined.
  const bool joined = corner[0] + corner[1] + corner[2] + corner[3] > 0.0;
  for (std::size_t e = 0; e < 4; ++e) {
    if (!inside(e) || inside(e + 1)) continue;
    std::size_t next = e;
    do {
      next = joined ? next + 1 : next + 3;
    } while (inside(next) || !inside(next + 1));
    links[edges[e]] = edges[next % 4];
  }
}

// `order` holds every edge that a contour crosses: the same values always give the same contours.
std::vector<Contour> trace_loops(const PaddedSlice& slice, Links links,
                                 const std::vector<std::int64_t>& order) {
  std::vector<Contour> loops;
  for (const std::int64_t start : order) {
    if (!links.contains(start)) continue;
    Contour& loop = loops.emplace_back();
    // Edges that were passed are removed; the contour is closed when none follows.
    for (auto here = links.find(start); here != links.end();) {
      loop.push_back(slice.crossing(here->first));
      const std::int64_t next = here->second;
      links.erase(here);
      here = links.find(next);
    }
  }
  return loops;
}

// Where the ray from `from` towards smaller i first meets a contour.
struct Meeting {
  std::size_t contour = 0;
  std::size_t edge = 0;  // from its point of that number to the next
  double i = 0.0;
};
std::optional<Meeting> meet(const std::vector<Contour>& contours, glm::dvec2 from) {
  std::optional<Meeting> nearest;
  for (std::size_t c = 0; c < contours.size(); ++c) {
    const Contour& contour = contours[c];
    for (std::size_t n = 0; n < contour.size(); ++n) {
      const glm::dvec2 a = contour[n];
      const glm::dvec2 b = contour[(n + 1) % contour.size()];
      if ((a.y <= from.y) == (b.y <= from.y)) continue;
      const double i = a.x + (from.y - a.y) * (b.x - a.x) / (b.y - a.y);
      if (i < from.x && (!nearest || i > nearest->i)) nearest = Meeting{c, n, i};
    }
  }
  return nearest;
}

// Joins holes to what is around them. The ray from a hole's leftmost point stays inside until it meets the
// contour around it or a hole further left, which is joined already.
std::vector<Contour> join_holes(std::vector<Contour> loops) {
  std::vector<Contour> regions;
  std::vector<Contour> holes;
  for (Contour& loop : loops) {
    if (signed_area(loop) > 0.0) {
      regions.push_back(std::move(loop));
      continue;
    }
    const auto leftmost =
        std::min_element(loop.begin(), loop.end(), [](glm::dvec2 a, glm::dvec2 b) { return a.x < b.x; });
    std::rotate(loop.begin(), leftmost, loop.end());
    holes.push_back(std::move(loop));
  }
  std::sort(holes.begin(), holes.end(),
            [](const Contour& a, const Contour& b) { return a.front().x < b.front().x; });
  for (const Contour& hole : holes) {
    const auto meeting = meet(regions, hole.front());
    if (!meeting) continue;  // cannot be: a hole lies in something
    Contour channel{{meeting->i, hole.front().y}};
    channel.insert(channel.end(), hole.begin(), hole.end());
    channel.push_back(hole.front());
    channel.push_back(channel.front());
    Contour& region = regions[meeting->contour];
    region.insert(region.begin() + static_cast<std::ptrdiff_t>(meeting->edge) + 1, channel.begin(),
                  channel.end());
  }
  return regions;
}

}  // namespace

std::vector<Contour> contours_of(const Segment& segment, const Geometry& geometry, std::int64_t k) {
  const auto found = segment.slices.find(k);
  if (found == segment.slices.end()) return {};
  return trace_contours(geometry.size.x, geometry.size.y, [&](std::int64_t i, std::int64_t j) {
    const bool inside = found->second[static_cast<std::size_t>(i + geometry.size.x * j)] != 0;
    if (!segment.phi) return inside ? 1.0 : -1.0;
    const double phi = segment.phi->value(geometry.offset({i, j, k}));
    // The voxels decide; phi says where between them.
    return inside ? std::max(phi, 1e-6) : std::min(phi, -1e-6);
  });
}

double signed_area(const Contour& contour) {
  double twice = 0.0;
  for (std::size_t n = 0; n < contour.size(); ++n) {
    const glm::dvec2 a = contour[n];
    const glm::dvec2 b = contour[(n + 1) % contour.size()];
    twice += a.x * b.y - b.x * a.y;
  }
  return 0.5 * twice;
}

std::vector<Contour> trace_contours(std::int64_t columns, std::int64_t rows,
                                    const std::function<double(std::int64_t, std::int64_t)>& value) {
  const PaddedSlice slice(columns, rows, value);
  Links links;
  std::vector<std::int64_t> order;
  for (std::int64_t j = -1; j < rows; ++j) {
    for (std::int64_t i = -1; i < columns; ++i) {
      const std::size_t before = links.size();
      link_cell(slice, i, j, links);
      if (links.size() == before) continue;
      for (const bool along_j : {false, true}) order.push_back(slice.edge(i, j, along_j));
    }
  }
  return join_holes(trace_loops(slice, std::move(links), order));
}

}  // namespace tidemark::imaging
