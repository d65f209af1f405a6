#include "imaging/dicom/csa_header.h"

#include <algorithm>
#include <optional>

#include "imaging/dicom/decimal.h"

namespace tidemark::imaging {
namespace {

// All numbers are 32 bits, little endian.
class CsaReader {
 public:
  explicit CsaReader(std::span<const std::uint8_t> bytes) : left_(bytes) {}

  std::optional<std::uint32_t> number() {
    const auto bytes = take(4);
    if (!bytes) return std::nullopt;
    std::uint32_t value = 0;
    for (std::size_t b = 4; b-- > 0;) value = value << 8 | (*bytes)[b];
    return value;
  }

  std::optional<std::span<const std::uint8_t>> take(std::size_t count) {
    if (count > left_.size()) return std::nullopt;
    const auto taken = left_.first(count);
    left_ = left_.subspan(count);
    return taken;
  }

 private:
  std::span<const std::uint8_t> left_;
};

// Up to the first zero.
std::string_view text_of(std::span<const std::uint8_t> bytes) {
  const auto end = std::find(bytes.begin(), bytes.end(), 0);
  return {reinterpret_cast<const char*>(bytes.data()), static_cast<std::size_t>(end - bytes.begin())};
}

struct CsaElement {
  std::string_view name;
  std::uint32_t items = 0;
};

// Name (64), multiplicity, representation (4), its number, items, a mark.
std::optional<CsaElement> read_element(CsaReader& reader) {
  const auto name = reader.take(64);
  if (!name || !reader.take(12)) return std::nullopt;
  const auto items = reader.number();
  if (!items || !reader.take(4)) return std::nullopt;
  return CsaElement{text_of(*name), *items};
}

}  // namespace

std::vector<double> csa_numbers(std::span<const std::uint8_t> header, std::string_view name) {
  CsaReader reader(header);
  const bool is_second_form = text_of(header.first(std::min<std::size_t>(header.size(), 4))) == "SV10";
  if (is_second_form) static_cast<void>(reader.take(8));
  const auto elements = reader.number();
  if (!elements || !reader.take(4)) return {};
  std::optional<std::uint32_t> first_items;
  for (std::uint32_t e = 0; e < *elements; ++e) {
    const auto element = read_element(reader);
    if (!element) return {};
    if (!first_items) first_items = element->items;
    std::vector<double> numbers;
    for (std::uint32_t i = 0; i < element->items; ++i) {
      const auto one = reader.number();
      const auto two = reader.number();
      if (!one || !two || !reader.take(8)) return {};
      // The first form gives the length by its excess over the first element's items.
      const std::uint32_t length = is_second_form ? *two : *one - *first_items;
      const auto value = reader.take(length);
      if (!value || !reader.take((4 - length % 4) % 4)) return {};
      if (element->name != name) continue;
      if (const auto number = parse_decimals(text_of(*value)); number && number->size() == 1) {
        numbers.push_back(number->front());
      }
    }
    if (element->name == name) return numbers;
  }
  return {};
}

}  // namespace tidemark::imaging
