#include "imaging/deidentify/shifted_date.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <string_view>

namespace tidemark::imaging {
namespace {

std::string shifted_date(std::string value, int days) {
  constexpr std::size_t kDigits = 8;
  if (value.size() == 10 && value[4] == '.' && value[7] == '.') std::erase(value, '.');
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (value.size() < kDigits || !std::all_of(value.begin(), value.begin() + kDigits, is_digit)) return {};
  const auto number = [&](std::size_t from, std::size_t count) {
    return std::stoi(value.substr(from, count));
  };
  const std::chrono::year_month_day day{std::chrono::year(number(0, 4)),
                                        std::chrono::month(static_cast<unsigned>(number(4, 2))),
                                        std::chrono::day(static_cast<unsigned>(number(6, 2)))};
  // What follows is a time and a zone, or it is no date.
  const std::string rest = value.substr(kDigits);
  const bool is_time = std::all_of(rest.begin(), rest.end(),
                                   [&](char c) { return is_digit(c) || c == '.' || c == '+' || c == '-'; });
  if (!day.ok() || !is_time) return {};
  const std::chrono::year_month_day moved = std::chrono::sys_days(day) + std::chrono::days(days);
  const int year = static_cast<int>(moved.year());
  if (year < 0 || year > 9999) return {};
  return fmt::format("{:04}{:02}{:02}{}", year, static_cast<unsigned>(moved.month()),
                     static_cast<unsigned>(moved.day()), rest);
}

}  // namespace

std::string shifted_dates(const std::string& values, int days) {
  std::string shifted;
  for (std::size_t at = 0;;) {
    const std::size_t end = std::min(values.find('\\', at), values.size());
    shifted += shifted_date(values.substr(at, end - at), days);
    if (end == values.size()) return shifted;
    shifted += '\\';
    at = end + 1;
  }
}

}  // namespace tidemark::imaging
