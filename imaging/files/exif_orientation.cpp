#include "imaging/files/exif_orientation.h"

#include <algorithm>
#include <array>

namespace tidemark::imaging::files {
namespace {

constexpr std::array<std::uint8_t, 6> kExif{'E', 'x', 'i', 'f', 0, 0};
constexpr std::uint32_t kOrientation = 274;
constexpr std::uint32_t kShort = 3;

// Numbers of a TIFF structure in the byte order that its beginning says; 0 beyond its end.
struct Numbers {
  std::span<const std::uint8_t> bytes;
  bool big_endian = false;

  [[nodiscard]] std::uint32_t at(std::size_t offset, std::size_t count) const {
    if (offset > bytes.size() || bytes.size() - offset < count) return 0;
    std::uint32_t number = 0;
    for (std::size_t n = 0; n < count; ++n) {
      number = number << 8 | bytes[offset + (big_endian ? n : count - 1 - n)];
    }
    return number;
  }
};

}  // namespace

std::optional<int> exif_orientation(std::span<const std::uint8_t> marker) {
  if (marker.size() < kExif.size() + 8 || !std::equal(kExif.begin(), kExif.end(), marker.begin())) return {};
  Numbers numbers{marker.subspan(kExif.size())};
  if (numbers.bytes[0] != numbers.bytes[1]) return {};
  numbers.big_endian = numbers.bytes[0] == 'M';
  const std::size_t directory = numbers.at(4, 4);
  const std::size_t entries = numbers.at(directory, 2);
  for (std::size_t n = 0; n < entries; ++n) {
    const std::size_t entry = directory + 2 + 12 * n;
    if (numbers.at(entry, 2) != kOrientation || numbers.at(entry + 2, 2) != kShort) continue;
    const std::uint32_t orientation = numbers.at(entry + 8, 2);
    if (orientation >= 1 && orientation <= 8) return static_cast<int>(orientation);
  }
  return {};
}

}  // namespace tidemark::imaging::files
