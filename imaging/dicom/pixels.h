// The values of one DICOM image.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/result.h"
#include "imaging/dicom/slice_header.h"

namespace tidemark {

struct SlicePixels {
  SliceHeader header;
  std::vector<std::int32_t> stored;  // before rescale, i (along a row) fastest
  bool ignored_bits = false;         // bits outside BitsStored were set and have been cleared
};

// Loads and decodes the file. Values are taken from the bits that HighBit and BitsStored name and
// sign-extended by PixelRepresentation (DICOM PS3.5 8.1.1). Fails (ErrorKind::input), naming the file, when
// the header has a problem, or when the pixel data is damaged or not as long as the header says.
[[nodiscard]] Result<SlicePixels> decode_slice(const std::filesystem::path& file);

}  // namespace tidemark
