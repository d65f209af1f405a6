// The drive of a level set as JSON, for recipes. Images and maps are references: their voxels are in their
// files.
#pragma once

#include "core/json/json.h"
#include "core/json/json_field.h"
#include "document/drive.h"

namespace tidemark::document {

// `before`: the walls and anchors of the drive before it in the recipe; null: it has none.
[[nodiscard]] Json to_json(const Drive& drive, const solver::Constraints* before);
// Of a volume of that size. Images and the map have no voxels yet. Errors are noted in the field's document.
Drive read_drive(const JsonField& field, Index3 grid_size,
                 const std::shared_ptr<const solver::Constraints>& before);

// An image without its voxels, and without the place where it is found.
[[nodiscard]] Json to_json(const CaseImage& image);
CaseImage read_image(const JsonField& field);

}  // namespace tidemark::document
