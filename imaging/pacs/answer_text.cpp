#include "imaging/pacs/answer_text.h"

#include <algorithm>

#include "core/number_from.h"
#include "imaging/pacs/services.h"

namespace tidemark::imaging {

std::optional<std::string> dicom_date(std::string_view text) {
  std::string digits;
  for (const char c : text) {
    if (c >= '0' && c <= '9') {
      digits += c;
    } else if (text.size() != 10 || (c != '-' && c != '.') || (digits.size() != 4 && digits.size() != 6)) {
      return std::nullopt;
    }
  }
  if (digits.size() != 8 || (text.size() != 8 && text.size() != 10)) return std::nullopt;
  const auto number = [&](std::size_t at) { return (digits[at] - '0') * 10 + digits[at + 1] - '0'; };
  if (number(4) < 1 || number(4) > 12 || number(6) < 1 || number(6) > 31) return std::nullopt;
  return digits;
}

std::string date_text(std::string text) {
  text.erase(text.find_last_not_of(' ') + 1);
  const auto digits = dicom_date(text);
  if (!digits) return {};
  return digits->substr(0, 4) + '-' + digits->substr(4, 2) + '-' + digits->substr(6);
}

std::optional<std::int64_t> count_of(std::string_view text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  const auto number = number_from<std::int64_t>(text);
  return number && *number >= 0 ? number : std::nullopt;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

std::string readable_name(const std::string& dicom_name) {
  std::string readable;
  for (const std::string& group : split(dicom_name, '=')) {
    const std::vector<std::string> parts = split(group, '^');
    std::string name = parts[0];
    for (std::size_t i = 1; i < parts.size() && i < 3; ++i) {  // then prefix and suffix
      if (!parts[i].empty()) name += (i == 1 ? ", " : " ") + parts[i];
    }
    if (name.empty()) continue;
    readable += (readable.empty() ? "" : " / ") + name;
  }
  return readable;
}

}  // namespace tidemark::imaging
