#include "imaging/dicom/decimal.h"

#include <charconv>
#include <cmath>

namespace tidemark::imaging {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kPadding(" \t\0", 3);
  const std::size_t first = text.find_first_not_of(kPadding);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kPadding) - first + 1);
}

template <class Number>
std::optional<Number> parse_one(std::string_view text) {
  text = trimmed(text);
  // from_chars knows no plus sign, and would take the minus of "+-1".
  if (text.starts_with('+')) {
    text.remove_prefix(1);
    if (text.starts_with('-')) return std::nullopt;
  }
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

template <class Number>
std::optional<std::vector<Number>> parse_all(std::string_view text) {
  std::vector<Number> values;
  for (;;) {
    const std::size_t separator = text.find('\\');
    const auto value = parse_one<Number>(text.substr(0, separator));
    if (!value) return std::nullopt;
    values.push_back(*value);
    if (separator == std::string_view::npos) return values;
    text.remove_prefix(separator + 1);
  }
}

}  // namespace

std::optional<std::vector<double>> parse_decimals(std::string_view text) {
  auto values = parse_all<double>(text);
  if (values) {
    for (const double value : *values) {
      if (!std::isfinite(value)) return std::nullopt;
    }
  }
  return values;
}

std::optional<std::vector<long long>> parse_integers(std::string_view text) {
  return parse_all<long long>(text);
}

}  // namespace tidemark::imaging
