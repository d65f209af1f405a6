// The detection of DICOM files.
#pragma once

#include "imaging/guard/byte_source.h"

namespace tidemark::imaging {

// As looks_like_dicom() (dicom.h), of a file that is open.
[[nodiscard]] bool begins_as_dicom(ByteSource& bytes);

}  // namespace tidemark::imaging
