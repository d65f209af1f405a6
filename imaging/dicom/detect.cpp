#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string_view>

#include "imaging/dicom/dicom.h"

namespace tidemark {
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

bool looks_like_dicom(const std::filesystem::path& file) {
  std::array<unsigned char, 256> bytes{};
  std::ifstream stream(file, std::ios::binary);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  const auto count = stream.gcount();
  if (count >= 132 && std::memcmp(bytes.data() + 128, "DICM", 4) == 0) return true;
  return count >= 8 && starts_with_element(bytes.data());
}

}  // namespace tidemark
