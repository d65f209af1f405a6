#include "imaging/dicom/element_text.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>
#include <string_view>

namespace tidemark::imaging {
namespace {

bool has_one_value(const DcmElement& element) {
  switch (element.ident()) {
    case EVR_LT:
    case EVR_ST:
    case EVR_UT:
    case EVR_UR:
      return true;
    default:
      return false;
  }
}

std::string_view without_blanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::string without_blanks_around_values(std::string_view text) {
  std::string values;
  values.reserve(text.size());
  for (;;) {
    const std::size_t end = std::min(text.find('\\'), text.size());
    values += without_blanks(text.substr(0, end));
    if (end == text.size()) return values;
    values += '\\';
    text.remove_prefix(end + 1);
  }
}

}  // namespace

std::string element_text(DcmElement& element) {
  if (element.getLength() > kLongestText) return {};
  char* bytes = nullptr;
  Uint32 count = 0;
  if (element.getString(bytes, count).bad()) {  // numbers, whose place DCMTK knows without a search
    OFString values;
    return element.getOFStringArray(values).good() ? std::string(values.c_str()) : std::string();
  }
  if (bytes == nullptr) return {};
  std::string_view text(bytes, count);
  text = text.substr(0, text.find('\0'));
  if (!has_one_value(element)) return without_blanks_around_values(text);
  return std::string(text.substr(0, text.find_last_not_of(' ') + 1));
}

std::string element_text(DcmItem& item, const DcmTagKey& key) {
  DcmElement* element = nullptr;
  if (item.findAndGetElement(key, element).bad() || element == nullptr) return {};
  return element_text(*element);
}

}  // namespace tidemark::imaging
