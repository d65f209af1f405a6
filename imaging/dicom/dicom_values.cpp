#include "imaging/dicom/dicom_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <random>

namespace tidemark::imaging {

std::string make_uid() {
  __extension__ using Number = unsigned __int128;
  std::random_device random;
  Number number = 0;
  for (int word = 0; word < 4; ++word) number = number << 32 | random();
  // Version 4 (random), variant 1.
  number = (number & ~(Number{0xf} << 76)) | Number{4} << 76;
  number = (number & ~(Number{3} << 62)) | Number{2} << 62;
  std::string digits;
  for (; number != 0; number /= 10) digits += static_cast<char>('0' + static_cast<int>(number % 10));
  std::reverse(digits.begin(), digits.end());
  return "2.25." + digits;
}

std::string decimal(double value) {
  if (value == 0.0) return "0";
  std::string text;
  for (int precision = 17; precision > 0; --precision) {
    text = fmt::format("{:.{}g}", value, precision);
    if (text.size() <= 16) break;
  }
  return text;
}

std::string short_text(std::string text) {
  for (char& c : text) {
    if (c == '\\' || static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
  if (text.size() > 64) {
    std::size_t end = 64;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
    text.resize(end);
  }
  return text;
}

bool is_ascii(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

Timestamp Timestamp::now() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm local{};
  localtime_r(&now, &local);
  return {fmt::format("{:04}{:02}{:02}", local.tm_year + 1900, local.tm_mon + 1, local.tm_mday),
          fmt::format("{:02}{:02}{:02}", local.tm_hour, local.tm_min, local.tm_sec)};
}

}  // namespace tidemark::imaging
