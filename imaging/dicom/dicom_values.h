// Values of attributes that are written: UIDs, decimal strings, text, dates. Private to imaging.
#pragma once

#include <string>

namespace tidemark::imaging {

// A UID from a random 128-bit number (DICOM PS3.5 B.2: "2.25." and a UUID as a decimal number).
[[nodiscard]] std::string make_uid();

// A decimal string (DS): at most 16 characters, as exact as they allow, the same in every locale.
[[nodiscard]] std::string decimal(double value);

// Several of them, separated by backslashes.
template <class... Values>
[[nodiscard]] std::string decimals(Values... values) {
  std::string text;
  (text.append(text.empty() ? "" : "\\").append(decimal(values)), ...);
  return text;
}

// Text of value representation LO or PN: no backslash (it separates values), no control characters, at most
// 64 bytes without cutting a UTF-8 sequence.
[[nodiscard]] std::string short_text(std::string text);

[[nodiscard]] bool is_ascii(const std::string& text);

// A moment as a date (DA) and a time (TM). By the clock of the place, as objects mean it that state no
// Timezone Offset From UTC (0008,0201).
struct Timestamp {
  std::string date;
  std::string time;

  static Timestamp now();
};

}  // namespace tidemark::imaging
