// A number from its text, whatever the locale.
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <system_error>
#include <type_traits>

namespace tidemark {

// The number that all of the text is, with at most one sign and no blank. Nothing where it is none, one that
// is not finite, or one beyond the type.
template <class Number>
[[nodiscard]] std::optional<Number> number_from(std::string_view text) {
  // from_chars knows no plus sign, and would take the minus of "+-1".
  if (text.starts_with('+')) {
    text.remove_prefix(1);
    if (text.starts_with('-')) return std::nullopt;
  }
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if constexpr (std::is_floating_point_v<Number>) {
    if (!std::isfinite(number)) return std::nullopt;
  }
  return number;
}

}  // namespace tidemark
