// Base64: bytes as text (RFC 4648, section 4).
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tidemark {

[[nodiscard]] std::string to_base64(std::string_view bytes);

// The bytes of a text with its padding. Nothing where it is no Base64, or has blanks or ends of lines. The
// bits that the last digit has beyond the last byte may be any.
[[nodiscard]] std::optional<std::string> from_base64(std::string_view text);

}  // namespace tidemark
