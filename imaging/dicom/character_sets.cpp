#include "imaging/dicom/character_sets.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcspchrs.h>
#include <dcmtk/ofstd/ofchrenc.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

namespace tidemark::imaging {
namespace {

constexpr char kEscape = '\x1b';

bool is_foreign(char c) {
  return static_cast<unsigned char>(c) >= 0x80 || c == kEscape;
}

bool is_within_sequence(char c) {
  return (static_cast<unsigned char>(c) & 0xc0U) == 0x80U;
}

bool is_japanese(const std::string& character_set) {
  const auto names = [&](std::string_view one) {
    const std::size_t at = character_set.find(one);
    if (at == std::string::npos) return false;
    const char next = character_set[at + one.size()];
    return next < '0' || next > '9';  // "IR 138" is Hebrew
  };
  return names("IR 13") || names("IR 87") || names("IR 159");
}

// The table of the bytes below 0x80, set by escape sequences (PS3.3 C.12.1.1.2).
enum class JapaneseTable { latin, jis_x0208, jis_x0212 };

struct Escape {
  std::string_view bytes;
  JapaneseTable table;
};
constexpr Escape kEscapes[] = {{"\x1b(B", JapaneseTable::latin},
                               {"\x1b(J", JapaneseTable::latin},
                               {"\x1b$@", JapaneseTable::jis_x0208},
                               {"\x1b$B", JapaneseTable::jis_x0208},
                               {"\x1b$(D", JapaneseTable::jis_x0212}};
constexpr std::string_view kKatakana = "\x1b)I";  // always in the bytes from 0xA1 on

// DCMTK leaves the Japanese tables to the C library, which does not have them by themselves. EUC-JP, which it
// has, holds the same tables at other places: each character is preceded by the shift to its table, and is a
// pair of bytes from 0xA1 on.
std::optional<std::string> as_euc_jp(std::string_view text) {
  constexpr char kShiftToKatakana = '\x8e';
  constexpr char kShiftToJisX0212 = '\x8f';
  std::string euc;
  JapaneseTable table = JapaneseTable::latin;
  while (!text.empty()) {
    const auto* escape = std::find_if(std::begin(kEscapes), std::end(kEscapes),
                                      [&](const Escape& one) { return text.starts_with(one.bytes); });
    if (escape != std::end(kEscapes)) {
      table = escape->table;
      text.remove_prefix(escape->bytes.size());
    } else if (text.starts_with(kKatakana)) {
      text.remove_prefix(kKatakana.size());
    } else if (static_cast<unsigned char>(text.front()) >= 0x80) {
      euc += {kShiftToKatakana, text.front()};
      text.remove_prefix(1);
    } else if (table == JapaneseTable::latin || text.front() <= ' ') {
      if (text.front() == kEscape) return std::nullopt;
      euc += text.front();
      text.remove_prefix(1);
    } else {
      if (text.size() < 2) return std::nullopt;
      if (table == JapaneseTable::jis_x0212) euc += kShiftToJisX0212;
      for (const char byte : text.substr(0, 2))
        euc += static_cast<char>(static_cast<unsigned char>(byte) | 0x80U);
      text.remove_prefix(2);
    }
  }
  return euc;
}

std::optional<std::string> from_japanese(const std::string& text) {
  const auto euc = as_euc_jp(text);
  if (!euc) return std::nullopt;
  OFCharacterEncoding converter;
  OFString converted;
  if (converter.selectEncoding("EUC-JP", "UTF-8").bad()) return std::nullopt;
  if (converter.convertString(OFString(euc->data(), euc->size()), converted).bad()) return std::nullopt;
  return std::string(converted.data(), converted.size());
}

std::optional<std::string> from_any(const std::string& text, const std::string& character_set,
                                    const std::string& delimiters) {
  DcmSpecificCharacterSet converter;
  OFString converted;
  if (converter.selectCharacterSet(character_set.c_str()).bad()) return std::nullopt;
  if (converter.convertString(text.c_str(), converted, delimiters.c_str()).bad()) return std::nullopt;
  return std::string(converted.data(), converted.size());
}

// Nothing where bytes are no characters of the set, or the set is none.
std::optional<std::string> from_set(const std::string& text, const std::string& character_set,
                                    const std::string& delimiters) {
  if (std::none_of(text.begin(), text.end(), is_foreign)) return text;
  return is_japanese(character_set) ? from_japanese(text) : from_any(text, character_set, delimiters);
}

}  // namespace

std::string in_utf8(std::string text, const std::string& character_set, const std::string& delimiters) {
  if (auto converted = from_set(text, character_set, delimiters)) return std::move(*converted);
  std::replace_if(text.begin(), text.end(), is_foreign, '?');
  return text;
}

std::string in_utf8_or_latin_1(std::string text, const std::string& character_set,
                               const std::string& delimiters) {
  if (auto converted = from_set(text, character_set, delimiters)) return std::move(*converted);
  std::replace(text.begin(), text.end(), kEscape, '?');
  return in_utf8(std::move(text), "ISO_IR 100");
}

std::string tidied(std::string_view text) {
  constexpr std::size_t kLongest = 800;  // bytes: three representations of 64 characters, and then some
  std::size_t end = text.size();
  if (end > kLongest) {
    // Not in the middle of a UTF-8 sequence.
    end = kLongest;
    while (end > 0 && is_within_sequence(text[end])) --end;
  }
  std::string result(text.substr(0, end));
  for (char& c : result) {
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
  result.erase(result.find_last_not_of(' ') + 1);
  result.erase(0, result.find_first_not_of(' '));
  return result;
}

}  // namespace tidemark::imaging
