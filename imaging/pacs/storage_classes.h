// The classes of objects that may be stored, and their encodings.
#pragma once

#include <string>
#include <vector>

#include "imaging/pacs/association.h"

namespace tidemark::imaging {

// Classes of objects that are of use here: slices and volumes, and segmentations of them.
[[nodiscard]] const std::vector<std::string>& storage_classes();
// The encodings of these classes, the best first: all that can be decoded.
[[nodiscard]] const std::vector<std::string>& storage_syntaxes();
[[nodiscard]] bool is_storage_class(const std::string& uid);

// A context for each class without compression, and for images one for each compression, so that a server may
// send its objects unchanged.
[[nodiscard]] std::vector<Proposal> storage_proposals();

}  // namespace tidemark::imaging
