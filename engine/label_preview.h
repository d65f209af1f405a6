// The preview of what labels are about to become, for views.
#pragma once

#include <vector>

#include "document/label_tool.h"

namespace tidemark::engine {

// What a tool would make of labels, or a stroke that is being drawn.
struct LabelPreview {
  document::LabelToolUse use;
  std::vector<std::uint8_t> labels;
  document::LabelVoxels from;
  std::vector<document::LabelRegion> regions;
  double before_ml = 0.0;  // of all labels that change
  double after_ml = 0.0;   // of all that they would become
};

}  // namespace tidemark::engine
