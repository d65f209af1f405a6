#include "tests/imaging/dicom/frame_bytes.h"

#include <utility>

namespace tidemark::test {
namespace {

std::string padded(std::string text, std::size_t size) {
  text.resize(size, '\0');
  return text;
}

}  // namespace

std::string sequence(std::uint32_t tag, const std::vector<std::string>& items) {
  std::string value;
  for (const std::string& one : items) value += item(one);
  return element(tag, "SQ", value);
}

std::string frame_groups(const std::string& position, const std::string& before, const std::string& after) {
  return before + sequence(0x00209113, {text(0x00200032, "DS", position)}) + after;
}

Dataset enhanced(int frames) {
  Dataset image = Dataset::slice();
  for (const std::uint32_t tag : {0x00200032U, 0x00200037U, 0x00280030U}) image.remove(tag);
  image.put_text(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.2.1");
  image.put_text(0x00280008, "IS", std::to_string(frames));
  image.put(kSharedGroups,
            sequence(kSharedGroups, {sequence(0x00209116, {text(0x00200037, "DS", "1\\0\\0\\0\\1\\0")}) +
                                     sequence(0x00289110, {text(0x00280030, "DS", "1\\1")})}));
  std::vector<std::string> groups;
  std::string pixels;
  for (int frame = 0; frame < frames; ++frame) {
    groups.push_back(frame_groups("0\\0\\" + std::to_string(frame)));
    for (std::uint32_t value = 0; value < 12; ++value)
      pixels += word(100 * value + static_cast<unsigned>(frame));
  }
  image.put(kFrameGroups, sequence(kFrameGroups, groups));
  return image.put(kPixels, element(kPixels, "OW", pixels));
}

std::string csa_bytes(const std::vector<std::pair<std::string, std::vector<std::string>>>& values) {
  std::string bytes = "SV10\4\3\2\1" + long_word(static_cast<std::uint32_t>(values.size())) + long_word(77);
  for (const auto& [name, items] : values) {
    bytes += padded(name, 64) + long_word(1) + padded("FD", 4) + long_word(4);
    bytes += long_word(static_cast<std::uint32_t>(items.size())) + long_word(77);
    for (const std::string& one : items) {
      const std::string length = long_word(static_cast<std::uint32_t>(one.size()));
      bytes += length + length + long_word(77) + length + padded(one, (one.size() + 3) / 4 * 4);
    }
  }
  return bytes;
}

std::string csa_in_first_form(std::string header, std::uint32_t first_items) {
  header.erase(0, 8);
  for (std::size_t at = 8; at < header.size();) {
    const auto items = static_cast<unsigned char>(header[at + 76]);
    at += 84;
    for (int i = 0; i < items; ++i) {
      const auto length = static_cast<unsigned char>(header[at]);
      header.replace(at, 4, long_word(length + first_items));
      at += 16 + (length + 3U) / 4U * 4U;
    }
  }
  return header;
}

std::string csa_of_mosaic() {
  return csa_bytes({{"NumberOfImagesInMosaic", {"4"}}, {"SliceNormalVector", {"0", "0", "1"}}});
}

Dataset mosaic(const std::string& csa_header) {
  Dataset image = Dataset::slice();
  image.put_text(0x00080008, "CS", "ORIGINAL\\PRIMARY\\M\\MOSAIC").put_number(0x00280010, 4);
  image.put_text(0x00180088, "DS", "2").put_text(0x00290010, "LO", "SIEMENS CSA HEADER");
  image.put(0x00291010, element(0x00291010, "OB", csa_header));
  std::string pixels;
  for (std::uint32_t value = 0; value < 16; ++value) pixels += word(100 * value);
  return image.put(kPixels, element(kPixels, "OW", pixels));
}

}  // namespace tidemark::test
