// Bytes as a short text, for JSON: deflated, in base 64.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::document {

[[nodiscard]] std::string pack_bytes(std::span<const std::byte> bytes);
// Nothing unless the text holds exactly `size` bytes. Takes no more memory than the text can hold: deflate
// makes at most 1032 bytes of one.
[[nodiscard]] std::optional<std::vector<std::byte>> unpack_bytes(std::string_view text, std::size_t size);

// One bit for each value that is not 0, packed.
[[nodiscard]] std::string pack_bits(std::span<const std::uint8_t> values);
// Values 0 and 1; nothing unless the text holds exactly `count` of them.
[[nodiscard]] std::optional<std::vector<std::uint8_t>> unpack_bits(std::string_view text, std::size_t count);

}  // namespace tidemark::document
