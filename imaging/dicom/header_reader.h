// The reader from a DICOM file to a SliceHeader.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "core/result.h"
#include "imaging/dicom/preflight.h"
#include "imaging/dicom/slice_header.h"
#include "imaging/guard/byte_source.h"

namespace tidemark {

// An image file whose header is read; its pixels are still on the disk.
struct ImageFile {
  // Of each slice in it, by frame and tile; never empty. One alone with a problem when it cannot be used.
  std::vector<SliceHeader> slices;
  Preflight checked;
  std::unique_ptr<FileBytes> bytes;
};

// Checks the file (preflight.h) and reads its header. Fails (ErrorKind::input) when the file is not a DICOM
// image; an image that cannot be slices of a volume is returned with its problem.
[[nodiscard]] Result<ImageFile> open_image(const std::filesystem::path& file);
[[nodiscard]] Result<std::vector<SliceHeader>> read_slice_headers(const std::filesystem::path& file);

}  // namespace tidemark
