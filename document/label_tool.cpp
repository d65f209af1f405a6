#include "document/label_tool.h"

#include <algorithm>

#include "imaging/regions/cut.h"
#include "imaging/regions/fill_slices.h"
#include "imaging/regions/islands.h"
#include "imaging/regions/margin.h"
#include "imaging/regions/smoothing.h"
#include "imaging/regions/watershed.h"
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

// The region that a label becomes, by a tool that makes no other labels.
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
    case LabelTool::mirror:
      return imaging::mirrored(region, grid.size, use.axis);
    case LabelTool::split:
    case LabelTool::watershed:
      break;
  }
  return region;
}

Result<std::vector<Region>> sides(const LabelToolUse& use, const Label& label, const Region& region,
                                  const LabelVoxels& from) {
  std::vector<Region> both{imaging::on_side(region, from.geometry, use.point_mm, use.normal)};
  both.push_back(difference(region, both.front()));
  if (both.front().empty() || both.back().empty())
    return fail(ErrorKind::usage, "the plane does not cut label {}", label.name);
  return both;
}

// The islands of `seeds` that have a voxel in the region or beside one of it: no other one grows into it.
Region islands_at(const Region& region, const Region& seeds) {
  const imaging::Islands islands(seeds);
  std::vector<bool> touches(islands.count());
  const auto is_beside = [&](Index3 voxel) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const std::int64_t way : {-1, 0, 1}) {
        Index3 there = voxel;
        there[axis] += way;
        if (region.contains(there)) return true;
      }
    }
    return false;
  };
  seeds.for_each_run([&](Index3 first, std::int64_t length) {
    const std::size_t island = *islands.at(first);
    for (std::int64_t i = 0; i < length && !touches[island]; ++i)
      touches[island] = is_beside(first + Index3(i, 0, 0));
  });
  return islands.region_of([&](std::size_t island) { return touches[island]; });
}

// The largest first, without seeds that take no voxel of the region.
Result<std::vector<Region>> basins(const LabelToolUse& use, const Label& label, const Region& region,
                                   const LabelVoxels& from, const Progress& progress) {
  const Region seeds = islands_at(region, from.region(use.other));
  auto parts = imaging::watershed(region, seeds, from.geometry, progress);
  if (!parts) return parts;
  std::erase_if(*parts, [&](const Region& part) { return intersection(part, region).empty(); });
  if (parts->size() < 2)
    return fail(ErrorKind::usage, "label {} is divided by two islands of seeds or more, and {} touch it",
                label.name, parts->size());
  std::stable_sort(parts->begin(), parts->end(),
                   [](const Region& a, const Region& b) { return a.count() > b.count(); });
  Region rest = region;  // that no seed reaches stays with the label
  for (const Region& part : *parts) rest = difference(rest, part);
  parts->front() = united(parts->front(), rest);
  return parts;
}

Result<std::vector<Region>> parts_of(const LabelToolUse& use, const Label& label, const Region& region,
                                     const LabelVoxels& from, const Progress& progress) {
  if (use.tool == LabelTool::split) return sides(use, label, region, from);
  if (use.tool == LabelTool::watershed) return basins(use, label, region, from, progress);
  auto result = changed(use, label, region, from, progress);
  if (!result) return pass_on(result);
  std::vector<Region> one;
  one.push_back(std::move(*result));
  return one;
}

Status check_other(const LabelToolUse& use, const std::vector<std::uint8_t>& labels,
                   const LabelVoxels& from) {
  if (!has_other(use.tool)) return {};
  const bool is_surface = has_surface(use);
  if (is_surface && use.tool == LabelTool::watershed)
    return fail(ErrorKind::usage, "the seeds must be islands of another label");
  if (is_surface && from.phi == nullptr) return fail(ErrorKind::usage, "there is no surface");
  if (is_surface) return {};
  const auto other = std::find_if(from.list.begin(), from.list.end(),
                                  [&](const Label& label) { return label.id == use.other; });
  if (other == from.list.end()) return fail(ErrorKind::usage, "there is no label {}", use.other);
  if (use.tool != LabelTool::watershed) return {};
  if (other->locked) return fail(ErrorKind::usage, "label {} is locked", other->name);
  if (std::find(labels.begin(), labels.end(), use.other) != labels.end())
    return fail(ErrorKind::usage, "the seeds must be islands of another label");
  return {};
}

}  // namespace

bool has_other(LabelTool tool) {
  return tool == LabelTool::add || tool == LabelTool::subtract || tool == LabelTool::intersect ||
         tool == LabelTool::watershed;
}

bool has_surface(const LabelToolUse& use) {
  return has_other(use.tool) && use.other == kTheSurface;
}

Region LabelVoxels::region(std::uint8_t label) const {
  if (label == kTheSurface) return phi == nullptr ? Region() : solver::inside_region(*phi);
  return voxels == nullptr ? Region() : Region(*voxels, label);
}

Result<std::vector<LabelRegion>> use_tool(const LabelToolUse& use, const std::vector<std::uint8_t>& labels,
                                          const LabelVoxels& from, const Progress& progress) {
  const auto find = [&](std::uint8_t id) {
    return std::find_if(from.list.begin(), from.list.end(),
                        [&](const Label& label) { return label.id == id; });
  };
  TIDEMARK_TRY(check_other(use, labels, from));
  std::vector<LabelRegion> results;
  // Seeds become voxels of the parts that they made.
  if (use.tool == LabelTool::watershed) results.push_back({use.other, {}, from.region(use.other)});
  for (std::size_t n = 0; n < labels.size(); ++n) {
    const auto label = find(labels[n]);
    if (label == from.list.end()) return fail(ErrorKind::usage, "there is no label {}", labels[n]);
    if (label->locked) return fail(ErrorKind::usage, "label {} is locked", label->name);
    const Region region = from.region(label->id);
    if (region.empty() && use.tool != LabelTool::add)
      return fail(ErrorKind::usage, "label {} has no voxel", label->name);
    auto parts = parts_of(use, *label, region, from,
                          progress.part(static_cast<int>(n), static_cast<int>(labels.size())));
    if (!parts) return pass_on(parts);
    for (std::size_t part = 0; part < parts->size(); ++part) {
      if (use.tool == LabelTool::watershed)
        results.front().region = difference(results.front().region, (*parts)[part]);
      const bool is_new = part > 0;
      results.push_back({is_new ? std::uint8_t{0} : label->id,
                         is_new ? fmt::format("{} {}", label->name, part + 1) : std::string(),
                         std::move((*parts)[part])});
    }
    if (progress.cancelled()) return cancelled_error();
  }
  return results;
}

}  // namespace tidemark::document
