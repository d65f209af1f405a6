#include <cstdint>
#include <string_view>

#include "imaging/audit/message.h"

namespace tidemark::imaging {
namespace {

constexpr std::uint32_t kReplacement = 0xFFFD;

// A character and the bytes that it took; those that begin none take one, and are U+FFFD.
struct Decoded {
  std::uint32_t character = kReplacement;
  std::size_t bytes = 1;
};

// RFC 3629: neither longer forms than are needed, nor surrogates, nor anything beyond U+10FFFF.
Decoded decode(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint8_t first = byte(0);
  if (first < 0x80) return {first, 1};
  const std::size_t bytes = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < bytes) return {};
  std::uint32_t character = first & (0xFFU >> (bytes + 1));
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return {};
    character = character << 6U | (byte(i) & 0x3FU);
  }
  constexpr std::uint32_t kSmallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_surrogate = character >= 0xD800 && character <= 0xDFFF;
  if (character < kSmallest[bytes] || is_surrogate || character > 0x10FFFF) return {};
  return {character, bytes};
}

// XML 1.0, 2.2 (Char).
bool is_of_xml(std::uint32_t character) {
  if (character < 0x20) return character == '\t' || character == '\n' || character == '\r';
  return character != 0xFFFE && character != 0xFFFF;
}

// Markup, and what a reader would normalise away or that syslog must not hold (RFC 5424 6.4, control codes).
bool is_escaped(std::uint32_t character) {
  return character < 0x20 || (character >= 0x7F && character < 0xA0) || character == '&' ||
         character == '<' || character == '>' || character == '"' || character == '\'';
}

}  // namespace

std::string xml_text(const std::string& text) {
  std::string all;
  for (std::string_view rest = text; !rest.empty();) {
    auto [character, bytes] = decode(rest);
    const bool is_good = is_of_xml(character) && (character != kReplacement || bytes > 1);
    if (!is_good) {
      all += "\xEF\xBF\xBD";  // U+FFFD
    } else if (is_escaped(character)) {
      all += fmt::format("&#{};", character);
    } else {
      all += rest.substr(0, bytes);
    }
    rest.remove_prefix(bytes);
  }
  return all;
}

}  // namespace tidemark::imaging
