// Functional groups of a frame (DICOM PS3.3 C.7.6.16). Private to this folder.
#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "imaging/results/segment_frames.h"

namespace tidemark::imaging {

// As far as they say it.
struct FrameGroups {
  std::optional<std::vector<double>> position_mm;
  std::optional<std::vector<double>> orientation;  // along a row, along a column
  std::optional<std::vector<double>> spacing_mm;   // between rows, between columns
  std::optional<Uint16> segment;
  std::optional<double> between_mm;
  std::optional<double> thickness_mm;
  double slope = 1.0;      // of stored values to those of the real world
  double intercept = 0.0;  // in its unit
};

// The frames of an object, in their order, as its groups describe them.
struct DescribedFrames {
  std::vector<SegmentFrame> frames;
  std::vector<FrameGroups> groups;  // one a frame
  std::optional<double> between_mm;
  double thickness_mm = 0.0;
};

// Reads the groups of all frames of a dataset. Text of all frames, which may be long, is read once. Fails
// (ErrorKind::input), naming the file and the frame, where a place is missing or makes no sense, and where no
// frame is described. A frame that names no segment has the number 0.
Result<DescribedFrames> read_frame_groups(DcmDataset& dataset, std::int64_t columns, std::int64_t rows,
                                          const std::string& file);

}  // namespace tidemark::imaging
