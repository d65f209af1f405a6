// Voxels written as text (NRRD "encoding: text", MetaImage "BinaryData = False").
#pragma once

#include <functional>

#include "imaging/guard/pixel_layout.h"

namespace tidemark::imaging::files {

// Hands each number and its index, which is below layout.voxels, to `take`. Fails (ErrorKind::input) naming
// the file when the text has not exactly as many finite numbers as the header says: the MetaImage library
// silently reads missing ones and other text as 0.
Status read_text(const PixelLayout& layout, const std::function<Status(std::int64_t, double)>& take);

}  // namespace tidemark::imaging::files
