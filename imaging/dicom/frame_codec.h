// Compressed frames, through DCMTK's codecs and ours.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "imaging/dicom/slice_header.h"
#include "imaging/guard/dicom/transfer_syntaxes.h"

namespace tidemark::imaging {

// One frame's fragments, decoded to words of BitsAllocated bits, the lower 16 first of those of 32. The error
// is one line about PixelData.
[[nodiscard]] tl::expected<std::vector<std::uint32_t>, std::string> decode_fragments(
    const std::vector<std::vector<std::uint8_t>>& fragments, const TransferSyntax& syntax,
    const SliceHeader& header);

// The same of a frame of 16 bits a pixel, into `target`, which is as large as the frame. Returns the error;
// empty when there is none.
[[nodiscard]] std::string decode_words(const std::vector<std::vector<std::uint8_t>>& fragments,
                                       const TransferSyntax& syntax, const SliceHeader& header,
                                       std::span<std::uint16_t> target);

}  // namespace tidemark::imaging
