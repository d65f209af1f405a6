// The regions that a segmentation file holds.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/cli/console.h"
#include "core/region.h"

namespace tidemark::cli {

// By name; one without a name where labels do not count.
struct FileRegions {
  std::string file;
  std::vector<std::pair<std::string, Region>> list;

  [[nodiscard]] const Region* find(const std::string& name) const;  // null: there is none
};

// A volume (every voxel that is not 0 is inside; with `labels` each number is a label), a DICOM segmentation
// or an RT structure set. `grid` becomes the file's own where it has none yet. Fails (ErrorKind::input)
// naming the file; what reading changed is a warning.
Result<FileRegions> read_regions(const std::string& file, bool labels, std::optional<Geometry>& grid,
                                 Console& console);

}  // namespace tidemark::cli
