#include "imaging/dicom/j2k_markers.h"

#include <algorithm>
#include <array>

namespace tidemark::imaging {
namespace {

// ISO 15444-1 table A.2; CAP is ISO 15444-15's.
constexpr unsigned kCapabilities = 0xff50;
constexpr unsigned kCodingStyle = 0xff52;
constexpr unsigned kComponentStyle = 0xff53;
constexpr unsigned kTilePart = 0xff90;
constexpr unsigned kData = 0xff93;
constexpr unsigned kEnd = 0xffd9;
// SIZ, TLM, PLM, PLT, QCD, QCC, RGN, POC, PPM, PPT, CRG, COM: they say nothing of code blocks.
constexpr std::array<unsigned, 12> kOthers{0xff51, 0xff55, 0xff57, 0xff58, 0xff5c, 0xff5d,
                                           0xff5e, 0xff5f, 0xff60, 0xff61, 0xff63, 0xff64};
// Where the style of the code blocks stands behind its marker: COD has five bytes that COC lacks, and COC the
// number of the component, one byte where there are less than 257 of them.
constexpr std::size_t kStyleInCodingStyle = 12;
constexpr std::size_t kStyleInComponentStyle = 9;
constexpr unsigned kHighThroughput = 0x40;

Status damaged() {
  return fail(ErrorKind::input, "the JPEG 2000 stream is damaged");
}

class Codestream {
 public:
  explicit Codestream(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  // Takes a step off `steps` for each marker, and refuses the stream when none is left.
  Status check(std::size_t& steps) const {
    std::size_t at = 2;  // behind SOC
    std::size_t tile_end = 0;
    // The decoder finds streams that end early.
    while (at + 4 <= bytes_.size()) {
      if (steps-- == 0) return damaged();
      const unsigned marker = word(at);
      if (marker == kEnd) return {};
      if (marker == kData) {
        if (tile_end <= at) return damaged();
        at = tile_end;
        continue;
      }
      const std::size_t length = word(at + 2);
      if (length < 2) return damaged();
      if (marker == kTilePart) {
        if (length != 10 || at + 12 > bytes_.size()) return damaged();
        const std::size_t size = std::size_t{word(at + 6)} << 16U | word(at + 8);
        tile_end = size == 0 ? bytes_.size() : at + size;
      } else
        TIDEMARK_TRY(check_style(marker, at, length));
      at += 2 + length;
    }
    return {};
  }

 private:
  [[nodiscard]] unsigned word(std::size_t at) const {
    return static_cast<unsigned>(bytes_[at]) << 8U | bytes_[at + 1];
  }

  [[nodiscard]] Status check_style(unsigned marker, std::size_t at, std::size_t length) const {
    bool is_high_throughput = marker == kCapabilities;
    if (marker == kCodingStyle || marker == kComponentStyle) {
      const std::size_t style = marker == kCodingStyle ? kStyleInCodingStyle : kStyleInComponentStyle;
      if (style >= 2 + length || at + style >= bytes_.size()) return damaged();
      is_high_throughput = (bytes_[at + style] & kHighThroughput) != 0;
    } else if (!is_high_throughput && std::find(kOthers.begin(), kOthers.end(), marker) == kOthers.end()) {
      return damaged();
    }
    if (!is_high_throughput) return {};
    return fail(ErrorKind::input, "the JPEG 2000 stream is a high-throughput one, which is not read");
  }

  std::span<const std::uint8_t> bytes_;
};

}  // namespace

Status require_part_one(std::span<const std::uint8_t> bytes) {
  constexpr std::array<std::uint8_t, 4> kStart{0xff, 0x4f, 0xff, 0x51};  // SOC and SIZ
  // Markers are four bytes and more: enough for several streams, one after the other, not for streams each of
  // which runs through all that begin behind it.
  std::size_t steps = bytes.size();
  auto start = std::search(bytes.begin(), bytes.end(), kStart.begin(), kStart.end());
  while (start != bytes.end()) {
    const auto stream = bytes.subspan(static_cast<std::size_t>(start - bytes.begin()));
    TIDEMARK_TRY(Codestream(stream).check(steps));
    // The boxes of a JP2 file may hold others; a codestream by itself is the only one.
    if (start == bytes.begin()) return {};
    start = std::search(start + 1, bytes.end(), kStart.begin(), kStart.end());
  }
  return {};
}

}  // namespace tidemark::imaging
