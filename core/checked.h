// Checked products of 64-bit sizes: a header cannot make us allocate a wrapped size.
#pragma once

#include <cstdint>
#include <optional>

namespace tidemark {

// The product of non-negative sizes; nothing when a factor is negative or the product exceeds 2^63 - 1.
template <class... Sizes>
[[nodiscard]] std::optional<std::int64_t> checked_product(Sizes... sizes) {
  std::int64_t product = 1;
  bool valid = true;
  const auto multiply = [&](std::int64_t size) {
    if (size < 0 || __builtin_mul_overflow(product, size, &product)) valid = false;
  };
  (multiply(static_cast<std::int64_t>(sizes)), ...);
  if (!valid) return std::nullopt;
  return product;
}

}  // namespace tidemark
