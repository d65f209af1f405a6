// The preview of what labels are about to become, for views.
#pragma once

#include <memory>
#include <vector>

#include "document/label_tool.h"

namespace tidemark::engine {

// What a tool would make of labels, or a stroke that is being drawn.
struct LabelPreview {
  document::LabelToolUse use;
  std::vector<std::uint8_t> labels;
  document::LabelVoxels from;
  document::Take take = document::Take::free_voxels;
  std::vector<document::LabelRegion> regions;
  std::shared_ptr<const document::Labels> after;  // all labels as they would be; null while a stroke is drawn
  bool changes = true;                            // whether any voxel would change
  double before_ml = 0.0;                         // of all labels that change
  double after_ml = 0.0;                          // of all that they would become
};

}  // namespace tidemark::engine
