// The regions that a segmentation file holds.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/progress.h"
#include "core/region.h"

namespace tidemark::document {

// By name; one without a name where labels do not count.
struct FileRegions {
  std::filesystem::path file;
  std::vector<std::pair<std::string, Region>> list;
  std::vector<std::string> changes;                   // found and left out by reading, one sentence each
  std::vector<std::string> frames_of_reference = {};  // as of imaging::Segments

  [[nodiscard]] const Region* find(const std::string& name) const;  // null: there is none
  [[nodiscard]] Region all() const;                                 // what is inside any of them
};

// A volume (every voxel that is not 0 is inside; with `labels` each number is a label), a DICOM segmentation
// or an RT structure set. `grid` becomes the file's own where it has none yet. Fails (ErrorKind::input)
// naming the file, (ErrorKind::cancelled).
Result<FileRegions> read_regions(const std::filesystem::path& file, bool labels,
                                 std::optional<Geometry>& grid, const Progress& progress = {});

}  // namespace tidemark::document
