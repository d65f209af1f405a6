// The reader from a DICOM file to a SliceHeader.
#pragma once

#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "core/result.h"
#include "imaging/dicom/slice_header.h"
#include "imaging/guard/byte_source.h"
#include "imaging/guard/dicom/preflight.h"

namespace tidemark::imaging {

// An image file whose header is read; its pixels are still on the disk.
struct ImageFile {
  // Of each slice in it, by frame and tile; never empty. One alone with a problem when it cannot be used.
  std::vector<SliceHeader> slices;
  Preflight checked;
  std::unique_ptr<FileBytes> bytes;
};

// Why there are no slices in a file, and whether some may be lost with it.
struct Refusal : Error {
  enum class Kind {
    damaged,    // may have held slices: it cannot be read, or contradicts itself
    not_dicom,  // does not begin as DICOM does
    no_slice,   // another object, or none that can be given to a series
  };
  // Whatever fails on the way to the slices is damage, unless the reader knows better.
  Refusal(Error error, Kind why = Kind::damaged) : Error(std::move(error)), file_kind(why) {}
  Kind file_kind;
};

template <class T>
using ImageResult = tl::expected<T, Refusal>;

// Checks the file (preflight.h) and reads its header. Fails (ErrorKind::input) when the file is not a DICOM
// image; an image that cannot be slices of a volume is returned with its problem.
[[nodiscard]] ImageResult<ImageFile> open_image(const std::filesystem::path& file);
[[nodiscard]] ImageResult<std::vector<SliceHeader>> read_slice_headers(const std::filesystem::path& file);

}  // namespace tidemark::imaging
