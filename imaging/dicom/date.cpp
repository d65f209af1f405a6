#include "imaging/dicom/date.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <string_view>

namespace tidemark::imaging {
namespace {

std::optional<std::chrono::year_month_day> day_of(std::string_view iso) {
  if (iso.size() != 10) return std::nullopt;
  const auto number = [&](std::size_t from, std::size_t count) {
    int value = 0;
    for (const char c : iso.substr(from, count)) value = 10 * value + (c - '0');
    return value;
  };
  const std::chrono::year_month_day day{std::chrono::year(number(0, 4)),
                                        std::chrono::month(static_cast<unsigned>(number(5, 2))),
                                        std::chrono::day(static_cast<unsigned>(number(8, 2)))};
  if (!day.ok()) return std::nullopt;
  return day;
}

}  // namespace

std::string iso_date(std::string text) {
  if (text.size() == 10 && text[4] == '.' && text[7] == '.') std::erase(text, '.');
  const bool digits = std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (text.size() != 8 || !digits) return {};
  return text.substr(0, 4) + '-' + text.substr(4, 2) + '-' + text.substr(6, 2);
}

std::string age_between(const std::string& birth, const std::string& study) {
  constexpr auto kOldest = std::chrono::years(130);
  const auto born = day_of(birth);
  const auto seen = day_of(study);
  if (!born || !seen || *seen < *born || *seen > *born + kOldest) return {};
  auto months = (seen->year() / seen->month() - born->year() / born->month()).count();
  if (seen->day() < born->day()) --months;
  if (months >= 24) return fmt::format("{}Y", months / 12);
  if (months >= 2) return fmt::format("{}M", months);
  return fmt::format("{}D", (std::chrono::sys_days(*seen) - std::chrono::sys_days(*born)).count());
}

}  // namespace tidemark::imaging
