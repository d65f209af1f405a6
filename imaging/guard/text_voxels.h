// Voxels written as text (NRRD "encoding: text", MetaImage "BinaryData = False"). Private to this folder.
#pragma once

#include "imaging/guard/pixel_layout.h"

namespace tidemark::imaging::files {

// As check_stream(). The MetaImage library silently reads missing numbers and other text as 0.
Status check_text(const PixelLayout& layout);

}  // namespace tidemark::imaging::files
