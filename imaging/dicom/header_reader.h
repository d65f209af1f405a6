// From a DICOM file to a SliceHeader.
#pragma once

#include <filesystem>

#include "core/result.h"
#include "imaging/dicom/slice_header.h"

class DcmFileFormat;

namespace tidemark {

// Parses the file; pixel data stays on the disk. Fails (ErrorKind::input) when the file is not a DICOM image;
// an image that cannot be a slice of a volume is returned with its problem.
[[nodiscard]] Result<SliceHeader> read_slice_header(const std::filesystem::path& file);

// The same of a file that `loaded` already holds.
[[nodiscard]] Result<SliceHeader> slice_header_of(DcmFileFormat& loaded, const std::filesystem::path& file);

}  // namespace tidemark
