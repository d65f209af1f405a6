// JPEG 2000 codestreams, through OpenJPEG.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/result.h"

namespace tidemark::imaging {

// One component, row after row.
struct J2kImage {
  std::int64_t columns = 0;
  std::int64_t rows = 0;
  int precision = 0;  // bits a value
  bool is_signed = false;
  std::vector<std::int32_t> values;
};

// Decodes a codestream (or a JP2 file) of exactly one component of columns x rows; the size is compared
// before any allocation. Fails (ErrorKind::input) without naming the file, which is not known here. Trailing
// bytes are allowed; a stream that ends early is not.
[[nodiscard]] Result<J2kImage> decode_j2k(std::span<const std::uint8_t> bytes, std::int64_t columns,
                                          std::int64_t rows);

}  // namespace tidemark::imaging
