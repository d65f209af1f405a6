// Voxels written as text (NRRD "encoding: text", MetaImage "BinaryData = False"). Private to this folder.
#pragma once

#include "imaging/guard/pixel_layout.h"

namespace tidemark::files {

// As check_stream(). The MetaImage library takes what is missing or is no number for 0 without a word.
Status check_text(const PixelLayout& layout);

}  // namespace tidemark::files
