// The studies that speed functions are measured on.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/study_loader.h"
#include "solver/speed/strokes.h"

namespace tidemark {

using Study = std::shared_ptr<const engine::LoadedStudy>;

// The phantom tumour, of 256 x 256 x 175 voxels, and the same in 512 x 512 x 300.
Result<Study> phantom_study();
Result<Study> large_phantom_study();
// Fails as load_volume() does.
Result<Study> study_of(const std::string& path);

// Where the level set starts: the middle of the tumour, or of the volume.
[[nodiscard]] Index3 start_of(const engine::LoadedStudy& study);

}  // namespace tidemark
