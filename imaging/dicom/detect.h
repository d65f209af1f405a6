// The detection of DICOM files.
#pragma once

#include "imaging/dicom/byte_source.h"

namespace tidemark {

// As looks_like_dicom() (dicom.h), of a file that is open.
[[nodiscard]] bool begins_as_dicom(ByteSource& bytes);

}  // namespace tidemark
