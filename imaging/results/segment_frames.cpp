#include "imaging/results/segment_frames.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "imaging/dicom/slice_places.h"

namespace tidemark::imaging {
namespace {

constexpr double kFrameTolerance = 0.1;  // of a voxel: files round their numbers
constexpr double kMostSlices = 4096.0;
// Of a grid with more than four times the pixels of its frames. Two small frames can say that they lie far
// apart.
constexpr double kMostVoxels = 0x1p28;

// A whole number of voxels that a distance in voxels is, wherever it ends up.
std::optional<Index3> whole(glm::dvec3 voxels) {
  constexpr double kFarthest = 1e9;
  const glm::dvec3 nearest = glm::round(voxels);
  const glm::dvec3 off = glm::abs(voxels - nearest);
  if (!(std::max({off.x, off.y, off.z}) <= kFrameTolerance)) return std::nullopt;  // NaN too
  if (glm::any(glm::greaterThan(glm::abs(nearest), glm::dvec3(kFarthest)))) return std::nullopt;
  return Index3(nearest);
}

// The step of one voxel along one axis that takes `count` steps from `first` to `last`.
std::optional<Index3> step_between(Index3 first, Index3 last, std::int64_t count, Index3 one_step) {
  if (count == 0) return one_step;
  const Index3 way = last - first;
  const Index3 step = way / count;
  if (step * count != way) return std::nullopt;
  return std::abs(step.x) + std::abs(step.y) + std::abs(step.z) == 1 ? std::optional(step) : std::nullopt;
}

glm::dvec3 normal_of(const SegmentFrame& frame) {
  return glm::cross(glm::normalize(frame.step_column_mm), glm::normalize(frame.step_row_mm));
}

// A frame that is not would need slices of the grid by the hundred.
bool are_parallel(const std::vector<SegmentFrame>& frames, glm::dvec3 normal) {
  return std::all_of(frames.begin(), frames.end(), [&](const SegmentFrame& frame) {
    return std::abs(glm::dot(normal_of(frame), normal)) > 1.0 - 1e-4;
  });
}

std::vector<double> gaps_between(std::vector<double> places, double same) {
  std::sort(places.begin(), places.end());
  std::vector<double> gaps;
  double last = places.front();
  for (const double place : places) {
    if (place - last <= same) continue;
    gaps.push_back(place - last);
    last = place;
  }
  return gaps;
}

bool divides(double step, const std::vector<double>& gaps) {
  return step > 0.0 && std::all_of(gaps.begin(), gaps.end(), [&](double gap) {
           return gap >= 0.9 * step && std::abs(gap / step - std::round(gap / step)) <= kFrameTolerance;
         });
}

// The way (mm) from its slice's corner to a frame that lies there but for the drift of slices that count as
// straight when they are loaded. Frames have the places of images, which drift.
glm::dvec3 drift_of(const SegmentFrame& frame, const Geometry& grid) {
  const glm::dvec3 voxel = grid.to_voxel(frame.position_mm);
  const glm::dvec3 drift = frame.position_mm - grid.to_patient({0.0, 0.0, voxel.z});
  const double length = std::abs(voxel.z) * grid.spacing_mm.z;
  return is_straight(glm::length(drift), length) ? drift : glm::dvec3(0.0);
}

}  // namespace

Result<FrameMap> map_frame(const SegmentFrame& frame, const Geometry& grid, const std::string& what) {
  const glm::dvec3 corner = frame.position_mm - drift_of(frame, grid);
  const auto column_end = corner + static_cast<double>(frame.columns - 1) * frame.step_column_mm;
  const auto row_end = corner + static_cast<double>(frame.rows - 1) * frame.step_row_mm;
  const auto first = whole(grid.to_voxel(corner));
  const auto last_column = whole(grid.to_voxel(column_end));
  const auto last_row = whole(grid.to_voxel(row_end));
  if (first && last_column && last_row) {
    const auto column = step_between(*first, *last_column, frame.columns - 1, {1, 0, 0});
    const auto row = step_between(*first, *last_row, frame.rows - 1, {0, 1, 0});
    if (column && row && *column != *row && *column != -*row) return FrameMap{*first, *column, *row};
  }
  const glm::dvec3 h = grid.spacing_mm;
  return fail(ErrorKind::input,
              "{}: its frames of {} x {} pixels of {:.4g} x {:.4g} mm do not lie on the voxels of the "
              "volume, {} x {} "
              "x {} of {:.4g} x {:.4g} x {:.4g} mm",
              what, frame.columns, frame.rows, glm::length(frame.step_column_mm),
              glm::length(frame.step_row_mm), grid.size.x, grid.size.y, grid.size.z, h.x, h.y, h.z);
}

Result<Geometry> grid_of_frames(const std::vector<SegmentFrame>& frames, std::optional<double> between_mm,
                                double thickness_mm, const std::string& what) {
  const SegmentFrame& one = frames.front();
  const glm::dvec3 row = glm::normalize(one.step_column_mm);
  const glm::dvec3 column = glm::normalize(one.step_row_mm);
  const glm::dvec3 normal = normal_of(one);
  Geometry grid;
  grid.direction = {row, column, normal};
  grid.spacing_mm = {glm::length(one.step_column_mm), glm::length(one.step_row_mm), 1.0};

  if (!are_parallel(frames, normal)) return fail(ErrorKind::input, "{}: its frames are not parallel", what);
  std::vector<double> places;
  for (const SegmentFrame& frame : frames) places.push_back(glm::dot(frame.position_mm, normal));
  const auto [lowest, highest] = std::minmax_element(places.begin(), places.end());
  const std::vector<double> gaps =
      gaps_between(places, 1e-3 * std::min(grid.spacing_mm.x, grid.spacing_mm.y));
  double step = thickness_mm > 0.0 ? thickness_mm : 1.0;
  if (!gaps.empty()) step = *std::min_element(gaps.begin(), gaps.end());
  if (between_mm && divides(*between_mm, gaps)) step = *between_mm;
  if (!divides(step, gaps)) {
    return fail(ErrorKind::input, "{}: its frames are not evenly apart: {:.4g} mm at the closest", what,
                step);
  }
  grid.spacing_mm.z = step;
  const double slices = std::round((*highest - *lowest) / step) + 1.0;
  const double area = static_cast<double>(one.columns) * static_cast<double>(one.rows);
  const double most = std::max(kMostVoxels, 4.0 * area * static_cast<double>(frames.size()));
  if (!(slices <= kMostSlices && slices * area <= most)) {
    return fail(
        ErrorKind::input,
        "{}: its frames lie {:.4g} mm apart, which makes too large a volume: {:.0f} slices of {} x {} "
        "voxels",
        what, *highest - *lowest, slices, one.columns, one.rows);
  }
  grid.size = {one.columns, one.rows, static_cast<std::int64_t>(slices)};
  grid.origin_mm = frames[static_cast<std::size_t>(lowest - places.begin())].position_mm;
  return grid;
}

}  // namespace tidemark::imaging
