#include "robot.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "imaging/regions/islands.h"
#include "solver/distance_transform.h"

namespace tidemark {
namespace {

constexpr double kDiscRadius = 2.5;  // voxels
constexpr double kFarthest = 40.0;   // distances are measured up to this, in smallest spacings

// The box of what is set, with a border of one voxel inside of the grid; unset when nothing is.
struct Box {
  Index3 first;
  Index3 last;
};
std::optional<Box> box_of(const Mask& mask) {
  const Index3 size = mask.geometry.size;
  Box box{size, Index3(-1)};
  for (std::int64_t i = 0; i < mask.geometry.voxel_count(); ++i) {
    if (mask.voxels[static_cast<std::size_t>(i)] == 0) continue;
    const Index3 v = mask.geometry.voxel_at(i);
    box.first = glm::min(box.first, v);
    box.last = glm::max(box.last, v);
  }
  if (box.last.x < 0) return std::nullopt;
  return Box{glm::max(box.first - Index3(1), Index3(0)), glm::min(box.last + Index3(1), size - Index3(1))};
}

Mask cropped(const Mask& mask, const Box& box) {
  Mask part;
  part.geometry.spacing_mm = mask.geometry.spacing_mm;
  part.geometry.size = box.last - box.first + Index3(1);
  for (std::int64_t i = 0; i < part.geometry.voxel_count(); ++i) {
    const Index3 v = box.first + part.geometry.voxel_at(i);
    part.voxels.push_back(mask.voxels[static_cast<std::size_t>(mask.geometry.offset(v))]);
  }
  return part;
}

// The voxel of the mask's largest part that is farthest from its border.
std::optional<Index3> deepest(const Mask& mask) {
  const auto box = box_of(mask);
  if (!box) return std::nullopt;
  const Mask near = cropped(mask, *box);
  const imaging::Islands islands{Region(near)};
  const Mask part = mask_of(
      islands.region_of([largest = islands.largest()](std::size_t island) { return island == largest; }),
      near.geometry);
  const solver::Field distance = solver::distance_transform(part, kFarthest);
  const std::vector<float> values = distance.dense();
  const auto most = std::max_element(values.begin(), values.end()) - values.begin();
  return box->first + part.geometry.voxel_at(most);
}

}  // namespace

Robot::Robot(const Mask& truth) : truth_(truth), painted_(truth.voxels.size(), 0) {}

bool Robot::is_inside(Index3 voxel) const {
  return truth_.voxels[static_cast<std::size_t>(truth_.geometry.offset(voxel))] != 0;
}

void Robot::begin() {
  Mask rest = truth_;
  const Index3 first = *deepest(rest);
  paint(first, true);
  // Farther than half of the object's size from the first one.
  const auto box = box_of(truth_);
  const glm::dvec3 extent = glm::dvec3(box->last - box->first) * truth_.geometry.spacing_mm;
  const double apart = 0.25 * std::max({extent.x, extent.y, extent.z});
  for (std::int64_t i = 0; i < rest.geometry.voxel_count(); ++i) {
    const glm::dvec3 way = glm::dvec3(rest.geometry.voxel_at(i) - first) * rest.geometry.spacing_mm;
    if (glm::length(way) < apart) rest.voxels[static_cast<std::size_t>(i)] = 0;
  }
  paint(deepest(rest).value_or(first), true);
  int outside = 0;
  for (int direction = 0; direction < 12 && outside < 3; ++direction) {
    const double angle = 2.0943951 * (direction % 3) + 0.5235988 * (direction / 3);
    const glm::dvec3 way(std::cos(angle), std::sin(angle), 0.0);
    const Index3 size = truth_.geometry.size;
    double last = -1.0;
    for (double r = 0.0; r < static_cast<double>(std::max(size.x, size.y)); r += 0.5) {
      const Index3 v(glm::round(glm::dvec3(first) + r * way));
      if (!truth_.geometry.contains(v)) break;
      if (is_inside(v)) last = r;
    }
    const Index3 v(glm::round(glm::dvec3(first) + (last + 4.0) * way));
    if (!truth_.geometry.contains(v) || is_inside(v)) continue;
    paint(v, false);
    ++outside;
  }
}

void Robot::correct(const Mask& found) {
  Mask miss = truth_;
  Mask leak = found;
  for (std::size_t i = 0; i < miss.voxels.size(); ++i) {
    const bool inside = truth_.voxels[i] != 0;
    const bool in_found = found.voxels[i] != 0;
    miss.voxels[i] = inside && !in_found && painted_[i] == 0;
    leak.voxels[i] = in_found && !inside && painted_[i] == 0;
  }
  if (const auto centre = deepest(miss)) paint(*centre, true);
  if (const auto centre = deepest(leak)) paint(*centre, false);
}

void Robot::paint(Index3 centre, bool inside) {
  const auto reach = static_cast<std::int64_t>(kDiscRadius);
  std::vector<std::int64_t>& stroke = inside ? strokes_.inside : strokes_.outside;
  for (std::int64_t y = -reach; y <= reach; ++y) {
    for (std::int64_t x = -reach; x <= reach; ++x) {
      const Index3 v = centre + Index3(x, y, 0);
      if (static_cast<double>(x * x + y * y) > kDiscRadius * kDiscRadius) continue;
      if (!truth_.geometry.contains(v) || is_inside(v) != inside) continue;
      const std::int64_t offset = truth_.geometry.offset(v);
      if (painted_[static_cast<std::size_t>(offset)]++ == 0) stroke.push_back(offset);
    }
  }
  std::sort(stroke.begin(), stroke.end());
  if (inside) inside_.push_back(centre);
  ++count_;
}

Mask connected(const Geometry& grid, const std::vector<double>& speed, const std::vector<Index3>& from) {
  Mask mask{grid, std::vector<std::uint8_t>(speed.size(), 0)};
  std::vector<Index3> waiting = from;
  const Index3 steps[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  while (!waiting.empty()) {
    const Index3 v = waiting.back();
    waiting.pop_back();
    if (!grid.contains(v)) continue;
    const auto at = static_cast<std::size_t>(grid.offset(v));
    if (mask.voxels[at] != 0 || speed[at] <= 0.0) continue;
    mask.voxels[at] = 1;
    for (const Index3& step : steps) waiting.push_back(v + step);
  }
  return mask;
}

}  // namespace tidemark
