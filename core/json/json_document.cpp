#include "core/json/json_document.h"

#include <algorithm>
#include <limits>

#include "core/json/json_scan.h"

namespace tidemark {
namespace {

// The four digits of an escape, which the scan has found to be hexadecimal.
std::uint32_t code_unit(const char* at) {
  std::uint32_t unit = 0;
  for (int digit = 0; digit < 4; ++digit) {
    const auto c = static_cast<unsigned char>(at[digit]);
    unit = unit << 4U | (c <= '9' ? c - '0' : (c | 0x20U) - 'a' + 10U);
  }
  return unit;
}

void append_utf8(std::string& text, std::uint32_t code) {
  const auto put = [&](std::uint32_t byte) { text.push_back(static_cast<char>(byte)); };
  const auto rest = [&](std::uint32_t shift) { put(0x80U | (code >> shift & 0x3fU)); };
  if (code < 0x80U) {
    put(code);
  } else if (code < 0x800U) {
    put(0xc0U | code >> 6U);
    rest(0);
  } else if (code < 0x10000U) {
    put(0xe0U | code >> 12U);
    rest(6);
    rest(0);
  } else {
    put(0xf0U | code >> 18U);
    rest(12);
    rest(6);
    rest(0);
  }
}

// What the escape at `at`, behind its backslash, stands for. Returns the byte after it.
const char* append_escape(std::string& text, const char* at) {
  switch (*at) {
    case 'b':
      text.push_back('\b');
      return at + 1;
    case 'f':
      text.push_back('\f');
      return at + 1;
    case 'n':
      text.push_back('\n');
      return at + 1;
    case 'r':
      text.push_back('\r');
      return at + 1;
    case 't':
      text.push_back('\t');
      return at + 1;
    case 'u':
      break;
    default:  // the character itself
      text.push_back(*at);
      return at + 1;
  }
  std::uint32_t code = code_unit(at + 1);
  at += 5;
  if (code >= 0xd800U && code < 0xdc00U) {  // a pair of surrogates
    code = 0x10000U + ((code - 0xd800U) << 10U) + (code_unit(at + 2) - 0xdc00U);
    at += 6;
  }
  append_utf8(text, code);
  return at;
}

}  // namespace

Result<JsonDocument> JsonDocument::parse(std::string_view text, const std::string& file,
                                         const JsonLimits& limits) {
  if (text.size() > std::min<std::size_t>(limits.bytes, std::numeric_limits<std::uint32_t>::max())) {
    return fail(ErrorKind::input, "{}: {} bytes, more than {} are not read", file, text.size(), limits.bytes);
  }
  JsonDocument document;
  document.text_ = text;
  JsonScan scan(text, limits, document.places_);
  if (scan.run()) return document;
  return fail(ErrorKind::input, "{}: {}", file, scan.problem());
}

JsonDocument::Kind JsonDocument::kind(Number value) const {
  switch (text_[places_[value].begin]) {
    case '{':
      return Kind::object;
    case '[':
      return Kind::list;
    case '"':
      return Kind::text;
    case 't':
    case 'f':
      return Kind::boolean;
    case 'n':
      return Kind::null;
    default:
      return Kind::number;
  }
}

std::string_view JsonDocument::word(Number value) const {
  const std::string_view rest = text_.substr(places_[value].begin);
  const std::size_t length = rest.find_first_of(" \t\n\r,]}");
  return rest.substr(0, length);
}

std::string JsonDocument::text(Number value, std::size_t longest) const {
  std::string result;
  const char* at = text_.data() + places_[value].begin + 1;
  while (*at != '"' && result.size() <= longest) {
    if (*at == '\\') {
      at = append_escape(result, at + 1);
    } else {
      const std::size_t room = std::max<std::size_t>(1, longest - result.size());
      const char* const begin = at;
      while (*at != '"' && *at != '\\' && static_cast<std::size_t>(at - begin) < room) ++at;
      result.append(begin, at);
    }
  }
  return result;
}

bool JsonDocument::is_text(Number value, std::string_view wanted) const {
  const char* at = text_.data() + places_[value].begin + 1;
  for (const char c : wanted) {
    if (*at == '\\') return text(value, wanted.size()) == wanted;
    if (*at == '"' || *at != c) return false;
    ++at;
  }
  return *at == '"';
}

}  // namespace tidemark
