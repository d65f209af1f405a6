#include "imaging/dicom/decimal.h"

#include "core/number_from.h"

namespace tidemark::imaging {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kPadding(" \t\0", 3);
  const std::size_t first = text.find_first_not_of(kPadding);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kPadding) - first + 1);
}

template <class Number>
std::optional<std::vector<Number>> parse_all(std::string_view text) {
  std::vector<Number> values;
  for (;;) {
    const std::size_t separator = text.find('\\');
    const auto value = number_from<Number>(trimmed(text.substr(0, separator)));
    if (!value) return std::nullopt;
    values.push_back(*value);
    if (separator == std::string_view::npos) return values;
    text.remove_prefix(separator + 1);
  }
}

}  // namespace

std::optional<std::vector<double>> parse_decimals(std::string_view text) {
  return parse_all<double>(text);
}

std::optional<std::vector<long long>> parse_integers(std::string_view text) {
  return parse_all<long long>(text);
}

}  // namespace tidemark::imaging
