#include "document/label_tool.h"

#include <algorithm>

#include "imaging/regions/cut.h"
#include "imaging/regions/fill_slices.h"
#include "imaging/regions/islands.h"
#include "imaging/regions/margin.h"
#include "imaging/regions/smoothing.h"
#include "solver/inside_region.h"

namespace tidemark::document {
namespace {

Result<Region> island_at(const Region& region, Index3 voxel, const std::string& label) {
  const imaging::Islands islands(region);
  const auto here = islands.at(voxel);
  if (!here) return fail(ErrorKind::usage, "the place that was chosen is not in label {}", label);
  return islands.region_of([&](std::size_t island) { return island == *here; });
}

Region largest_island(const Region& region) {
  const imaging::Islands islands(region);
  return islands.region_of([largest = islands.largest()](std::size_t island) { return island == largest; });
}

Region without_small_islands(const Region& region, double ml, const Geometry& grid) {
  const imaging::Islands islands(region);
  return islands.region_of([&](std::size_t island) {
    return static_cast<double>(islands.voxels()[island]) * grid.voxel_volume_ml() >= ml;
  });
}

// The region that a label becomes.
Result<Region> changed(const LabelToolUse& use, const Label& label, const Region& region,
                       const LabelVoxels& from, const Progress& progress) {
  const Geometry& grid = from.geometry;
  switch (use.tool) {
    case LabelTool::largest_island:
      return largest_island(region);
    case LabelTool::island_here:
      return island_at(region, use.voxel, label.name);
    case LabelTool::small_islands:
      return without_small_islands(region, use.amount, grid);
    case LabelTool::holes:
      return imaging::without_holes(region, grid.size, imaging::Touching::in_volume);
    case LabelTool::slice_holes:
      return imaging::without_holes(region, grid.size, imaging::Touching::in_slices);
    case LabelTool::grow:
      return imaging::grown(region, grid, use.amount, progress);
    case LabelTool::shrink:
      return imaging::shrunk(region, grid, use.amount, progress);
    case LabelTool::median:
      return imaging::smoothed_by_median(region, grid, use.amount, progress);
    case LabelTool::gaussian:
      return imaging::smoothed_by_gaussian(region, grid, use.amount, progress);
    case LabelTool::slices:
      return imaging::with_slices_filled(region, grid, use.axis, progress);
    case LabelTool::add:
      return united(region, from.region(use.other));
    case LabelTool::subtract:
      return difference(region, from.region(use.other));
    case LabelTool::intersect:
      return intersection(region, from.region(use.other));
    case LabelTool::split:
      return imaging::on_side(region, grid, use.point_mm, use.normal);
    case LabelTool::mirror:
      return imaging::mirrored(region, grid.size, use.axis);
  }
  return region;
}

bool has_other(LabelTool tool) {
  return tool == LabelTool::add || tool == LabelTool::subtract || tool == LabelTool::intersect;
}

}  // namespace

Region LabelVoxels::region(std::uint8_t label) const {
  if (label == kTheSurface) return phi == nullptr ? Region() : solver::inside_region(*phi);
  return voxels == nullptr ? Region() : Region(*voxels, label, geometry.size);
}

Result<std::vector<LabelRegion>> use_tool(const LabelToolUse& use, const std::vector<std::uint8_t>& labels,
                                          const LabelVoxels& from, const Progress& progress) {
  const auto find = [&](std::uint8_t id) {
    return std::find_if(from.list.begin(), from.list.end(),
                        [&](const Label& label) { return label.id == id; });
  };
  if (has_other(use.tool)) {
    if (use.other == kTheSurface && from.phi == nullptr) return fail(ErrorKind::usage, "there is no surface");
    if (use.other != kTheSurface && find(use.other) == from.list.end())
      return fail(ErrorKind::usage, "there is no label {}", use.other);
  }
  std::vector<LabelRegion> results;
  for (std::size_t n = 0; n < labels.size(); ++n) {
    const auto label = find(labels[n]);
    if (label == from.list.end()) return fail(ErrorKind::usage, "there is no label {}", labels[n]);
    if (label->locked) return fail(ErrorKind::usage, "label {} is locked", label->name);
    const Region region = from.region(label->id);
    if (region.empty() && use.tool != LabelTool::add)
      return fail(ErrorKind::usage, "label {} has no voxel", label->name);
    auto result = changed(use, *label, region, from,
                          progress.part(static_cast<int>(n), static_cast<int>(labels.size())));
    if (!result) return pass_on(result);
    if (use.tool == LabelTool::split) {
      Region behind = difference(region, *result);
      if (behind.empty() || result->empty())
        return fail(ErrorKind::usage, "the plane does not cut label {}", label->name);
      results.push_back({label->id, {}, std::move(*result)});
      results.push_back({0, label->name + " 2", std::move(behind)});
    } else {
      results.push_back({label->id, {}, std::move(*result)});
    }
    if (progress.cancelled()) return cancelled_error();
  }
  return results;
}

}  // namespace tidemark::document
