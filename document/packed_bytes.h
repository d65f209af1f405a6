// Bytes as a short text, for JSON: deflated, in base 64.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/bit_mask.h"

namespace tidemark::document {

[[nodiscard]] std::string pack_bytes(std::span<const std::byte> bytes);
// Nothing unless the text holds exactly `size` bytes. Takes no more memory than the text can hold: deflate
// makes at most 1032 bytes of one.
[[nodiscard]] std::optional<std::vector<std::byte>> unpack_bytes(std::string_view text, std::size_t size);

// A mask whose bits were packed; nothing unless the text holds exactly those of the grid.
[[nodiscard]] std::optional<BitMask> unpack_mask(std::string_view text, const Geometry& grid);

}  // namespace tidemark::document
