#include "imaging/dicom/detect.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "imaging/dicom/dicom.h"

namespace tidemark::imaging {
namespace {

// Whether a data element with a tag of group 0002 or 0008 stands at the start, as in files that were stored
// without preamble: explicit (two letters of value representation) or implicit (a short length).
bool starts_with_element(const unsigned char* bytes) {
  const auto word = [&](int at, bool big) {
    return big ? bytes[at] << 8 | bytes[at + 1] : bytes[at + 1] << 8 | bytes[at];
  };
  for (const bool big : {false, true}) {
    const int group = word(0, big);
    if (group != 0x0002 && group != 0x0008) continue;
    if (word(2, big) > 0x00ff) continue;  // both groups begin with small element numbers
    constexpr std::string_view kRepresentations = "AE CS DA DT LO LT OB PN SH SQ ST TM UI UL UN US";
    const std::string_view two(reinterpret_cast<const char*>(bytes) + 4, 2);
    const std::size_t found = kRepresentations.find(two);
    if (found != std::string_view::npos && found % 3 == 0) return true;
    const std::uint32_t length =
        static_cast<std::uint32_t>(word(6, false)) << 16 | static_cast<std::uint32_t>(word(4, false));
    if (!big && length <= 1024) return true;
  }
  return false;
}

}  // namespace

bool begins_as_dicom(ByteSource& source) {
  std::array<std::uint8_t, 132> bytes{};
  const std::size_t count = source.read(0, bytes);
  if (count == bytes.size() && std::memcmp(bytes.data() + 128, "DICM", 4) == 0) return true;
  return count >= 8 && starts_with_element(bytes.data());
}

bool looks_like_dicom(const std::filesystem::path& file) {
  auto bytes = FileBytes::open(file);
  return bytes && begins_as_dicom(*bytes);
}

}  // namespace tidemark::imaging
