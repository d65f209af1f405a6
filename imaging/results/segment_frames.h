// The place of a segmentation's frames on a grid. Private to this folder.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry.h"
#include "core/result.h"

namespace tidemark::imaging {

// A plane of pixels in the patient; column c and row r lie at position + c * step_column + r * step_row.
struct SegmentFrame {
  std::uint16_t segment = 0;  // its number, from 1
  std::int64_t columns = 0;
  std::int64_t rows = 0;
  glm::dvec3 position_mm{0.0};
  glm::dvec3 step_column_mm{1.0, 0.0, 0.0};
  glm::dvec3 step_row_mm{0.0, 1.0, 0.0};
};

// The voxel of pixel (0, 0) and the steps to the next column and the next row.
struct FrameMap {
  Index3 first{0};
  Index3 column{1, 0, 0};
  Index3 row{0, 1, 0};
};

// Fails (ErrorKind::input) when the pixels are not voxels of the grid, each at the same place in the patient
// within a tenth of a voxel, or as far off as slices may drift (is_straight()); they may lie beyond its
// border. `what` names the file in the message.
Result<FrameMap> map_frame(const SegmentFrame& frame, const Geometry& grid, const std::string& what);

// The smallest grid that holds all frames: slices along their normal, `between_mm` apart if that fits, else
// as far apart as the nearest two. Fails (ErrorKind::input) when they are not parallel or evenly apart, or
// so far apart that it would be empty for the most part, and large.
Result<Geometry> grid_of_frames(const std::vector<SegmentFrame>& frames, std::optional<double> between_mm,
                                double thickness_mm, const std::string& what);

}  // namespace tidemark::imaging
