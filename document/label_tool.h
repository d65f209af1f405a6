// The tools that finish labels: each makes another region of a label's.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "document/labels.h"

namespace tidemark::document {

enum class LabelTool {
  largest_island,  // keeps the largest island alone
  island_here,     // keeps the island at a voxel alone
  small_islands,   // removes islands below an amount of ml
  holes,           // fills what is enclosed in the volume
  slice_holes,     // fills what is enclosed in its slice
  grow,            // by mm
  shrink,          // by mm
  median,          // of a ball with a radius in mm
  gaussian,        // with a standard deviation in mm; the volume is kept
  slices,          // fills empty slices between others
  add,             // the inside of the surface, or another label
  subtract,
  intersect,
  split,      // by a plane: what is behind it becomes a new label
  watershed,  // at its necks, from the islands of another label: each gets a label
  mirror,     // at the middle of the grid, along an axis
};

inline constexpr std::uint8_t kTheSurface = 0;  // in place of a label

// Whether a tool works with another label, or the surface.
[[nodiscard]] bool has_other(LabelTool tool);

// A tool with its numbers. Those that it has no use for are ignored.
struct LabelToolUse {
  LabelTool tool = LabelTool::largest_island;
  double amount = 1.0;  // mm or ml
  int axis = 2;         // of the grid: 0, 1, 2
  Index3 voxel{0};      // island_here
  // Of add, subtract, intersect: another label, or the surface. Of watershed: the label of the seeds, which
  // keeps those that are beside the label.
  std::uint8_t other = kTheSurface;
  glm::dvec3 point_mm{0.0};          // a point of the plane of split (LPS)
  glm::dvec3 normal{0.0, 0.0, 1.0};  // what it points to stays
  bool operator==(const LabelToolUse&) const = default;
};

// Whether the surface has a part in what comes of it.
[[nodiscard]] bool has_surface(const LabelToolUse& use);

// Labels as values, for work beside the case.
struct LabelVoxels {
  Geometry geometry;
  std::vector<Label> list;
  std::shared_ptr<const PagedBytes> voxels;  // null: none has a label
  std::shared_ptr<const solver::Field> phi;  // of the surface; null: there is none

  // Of a label, or what is inside of the surface.
  [[nodiscard]] Region region(std::uint8_t label) const;
  // Shares the pages; without a label where there is none.
  [[nodiscard]] PagedBytes all() const { return voxels ? *voxels : PagedBytes(geometry.size); }
};

// What the labels would become, for Labels::finish(). Fails (ErrorKind::usage) where a label is unknown or
// locked, where the tool has nothing to work on, or a number is out of its range; (ErrorKind::cancelled).
Result<std::vector<LabelRegion>> use_tool(const LabelToolUse& use, const std::vector<std::uint8_t>& labels,
                                          const LabelVoxels& from, const Progress& progress = {});

}  // namespace tidemark::document
