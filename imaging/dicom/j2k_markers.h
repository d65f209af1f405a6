// The markers of a JPEG 2000 codestream, looked at before OpenJPEG is.
#pragma once

#include <cstdint>
#include <span>

#include "core/result.h"

namespace tidemark::imaging {

// Refuses (ErrorKind::input, without naming a file) codestreams of high-throughput code blocks (ISO
// 15444-15), and those whose markers cannot be followed: OpenJPEG 2.5.0 decodes such blocks, but one that is
// damaged ends the program by an assertion (mel_init in ht_dec.c). `bytes` is a codestream, or a JP2 file
// with some.
[[nodiscard]] Status require_part_one(std::span<const std::uint8_t> bytes);

}  // namespace tidemark::imaging
