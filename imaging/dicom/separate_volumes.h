// The search for the attribute that tells the volumes at one place apart.
#pragma once

#include <string>
#include <vector>

#include "imaging/dicom/slice_header.h"

namespace tidemark::imaging {

using SliceRefs = std::vector<const SliceHeader*>;

struct LabelledSlices {
  std::string label;
  SliceRefs slices;
};

// Slices of one size, orientation and pixel spacing. One volume with an empty label when no two slices share
// a position, or no attribute tells them apart.
[[nodiscard]] std::vector<LabelledSlices> separate_volumes(const SliceRefs& slices);

// "echo 2" and "time 1 of 3" as "echo 2, time 1 of 3"; either may be empty.
[[nodiscard]] std::string join_labels(const std::string& a, const std::string& b);

}  // namespace tidemark::imaging
