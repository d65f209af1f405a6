#include "imaging/dicom/attribute_reader.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <fmt/format.h>

#include <algorithm>

#include "imaging/dicom/decimal.h"
#include "imaging/dicom/element_text.h"

namespace tidemark::imaging {
namespace {

// Without a known representation, like private elements of implicit coding.
bool is_bytes(DcmElement& element) {
  switch (element.ident()) {
    case EVR_OB:
    case EVR_OW:
    case EVR_UN:
    case EVR_UNKNOWN:
    case EVR_UNKNOWN2B:
      return true;
    default:
      return false;
  }
}

// Bytes that can only be text; empty when they may be something else.
std::string printable_text(DcmElement& element) {
  Uint8* bytes = nullptr;
  if (element.getUint8Array(bytes).bad() || bytes == nullptr) return {};
  const std::string text(reinterpret_cast<const char*>(bytes), element.getLength());
  const bool is_text = std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; });
  return is_text ? text : std::string();
}

}  // namespace

std::string name_of(const DcmTagKey& key) {
  DcmTag tag(key);
  return fmt::format("{} ({:04X},{:04X})", tag.getTagName(), key.getGroup(), key.getElement());
}

std::string AttributeReader::text(const DcmTagKey& key) const {
  DcmElement* element = nullptr;
  if (item_.findAndGetElement(key, element).bad() || element == nullptr) return {};
  if (element->getLength() > kLongestText) return {};
  std::string result = is_bytes(*element) ? printable_text(*element) : element_text(*element);
  result.erase(result.find_last_not_of(' ') + 1);
  return result;
}

std::string AttributeReader::name(const DcmTagKey& key) const {
  constexpr std::size_t kLongest = 256;
  std::string result = text(key);
  if (result.size() > kLongest) result = result.substr(0, kLongest);
  return result;
}

std::optional<std::vector<double>> AttributeReader::decimals(const DcmTagKey& key, std::size_t count) {
  const std::string value = text(key);
  if (value.empty()) return std::nullopt;
  auto numbers = parse_decimals(value);
  if (!numbers || (count != 0 && numbers->size() != count)) {
    report(fmt::format("{} is '{}'", name_of(key), value.substr(0, 80)));
    return std::nullopt;
  }
  return numbers;
}

std::optional<double> AttributeReader::number(const DcmTagKey& key) const {
  const std::string value = text(key);
  const auto numbers = parse_decimals(value.substr(0, value.find('\\')));
  if (!numbers) return std::nullopt;
  return numbers->front();
}

std::int64_t AttributeReader::whole(const DcmTagKey& key, std::int64_t low, std::int64_t high) {
  long int value = 0;
  if (item_.findAndGetLongInt(key, value).bad()) {
    report(fmt::format("{} is missing or not a whole number", name_of(key)));
    return 0;
  }
  if (value < low || value > high) {
    report(fmt::format("{} is {}, not {} to {}", name_of(key), value, low, high));
    return 0;
  }
  return value;
}

DcmItem* AttributeReader::first_item(const DcmTagKey& sequence) const {
  DcmItem* item = nullptr;
  return item_.findAndGetSequenceItem(sequence, item, 0).good() ? item : nullptr;
}

}  // namespace tidemark::imaging
