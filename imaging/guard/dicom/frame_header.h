// A compressed frame's own size, read before a decoder takes memory for it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "imaging/guard/byte_source.h"
#include "imaging/guard/dicom/transfer_syntaxes.h"

namespace tidemark::imaging {

struct FrameSize {
  std::int64_t columns = 0;
  std::int64_t rows = 0;
  std::int64_t components = 0;
  std::int64_t tiles = 1;  // JPEG 2000
};

// Of the frame that begins at `begin` and lasts at most to `end`: the start-of-frame marker of JPEG and
// JPEG-LS (ISO 10918-1 B.2.2, ISO 14495-1 C.2.2), the SIZ marker of JPEG 2000 (ISO 15444-1 A.5.1). Nothing
// when there is none, and for RLE, which has no size of its own.
[[nodiscard]] std::optional<FrameSize> read_frame_size(FrameCoding coding, ByteReader& reader,
                                                       std::int64_t begin, std::int64_t end);

// The reason why a frame of that size is none of an image of `expected` size (its tiles do not count), in one
// line about PixelData; empty when it is one.
[[nodiscard]] std::string frame_problem(FrameCoding coding, const std::optional<FrameSize>& size,
                                        const FrameSize& expected);

}  // namespace tidemark::imaging
