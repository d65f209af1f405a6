#include "imaging/guard/dicom/frame_header.h"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::imaging {
namespace {

// Markers or boxes in front of the one that is looked for.
constexpr int kMostPassed = 10000;
// A decoder keeps some kilobytes a tile: there may be one for every so many pixels, and a few more.
constexpr std::int64_t kSmallestTile = 1024;
constexpr std::int64_t kFewTiles = 64;

std::int64_t word(const std::uint8_t* bytes) {
  return bytes[0] << 8 | bytes[1];
}

std::int64_t long_word(const std::uint8_t* bytes) {
  return word(bytes) << 16 | word(bytes + 2);
}

// SOF0 to SOF15, of which C4, C8 and CC are other things; SOF55 is JPEG-LS's.
bool starts_frame(int marker, FrameCoding coding) {
  if (coding == FrameCoding::jpeg_ls) return marker == 0xf7;
  return marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
}

// What may stand in front of a frame: DHT, DAC, DQT, DRI, LSE, APPn and comments. DCMTK looks for the frame
// too, and stays for ever at others (TEM, for one).
bool is_table(int marker) {
  return marker == 0xc4 || marker == 0xcc || marker == 0xdb || marker == 0xdd || marker == 0xf8 ||
         (marker >= 0xe0 && marker <= 0xef) || marker == 0xfe;
}

std::optional<FrameSize> read_jpeg(FrameCoding coding, ByteReader& reader, std::int64_t begin,
                                   std::int64_t end) {
  const std::uint8_t* bytes = begin + 2 <= end ? reader.at(begin, 2) : nullptr;
  if (bytes == nullptr || word(bytes) != 0xffd8) return std::nullopt;
  std::int64_t at = begin + 2;
  for (int passed = 0; passed < kMostPassed && at + 10 <= end; ++passed) {
    bytes = reader.at(at, 10);
    if (bytes == nullptr || bytes[0] != 0xff) return std::nullopt;
    if (starts_frame(bytes[1], coding)) return FrameSize{word(bytes + 7), word(bytes + 5), bytes[9], 1};
    if (!is_table(bytes[1]) || word(bytes + 2) < 2) return std::nullopt;
    at += 2 + word(bytes + 2);
  }
  return std::nullopt;
}

// Where the codestream begins: at once, or in the box "jp2c" of a JP2 file (ISO 15444-1 I.4), which some
// writers wrap it in.
std::int64_t find_codestream(ByteReader& reader, std::int64_t begin, std::int64_t end) {
  constexpr std::int64_t kSignatureBox = 12;
  constexpr std::int64_t kCodestreamBox = 0x6a703263;
  const std::uint8_t* bytes = begin + 8 <= end ? reader.at(begin, 8) : nullptr;
  if (bytes == nullptr || long_word(bytes) != kSignatureBox) return begin;
  std::int64_t at = begin;
  for (int passed = 0; passed < kMostPassed && at + 8 <= end; ++passed) {
    bytes = reader.at(at, 8);
    if (bytes == nullptr) break;
    if (long_word(bytes + 4) == kCodestreamBox) return at + 8;
    at += std::max<std::int64_t>(8, long_word(bytes));
  }
  return end;
}

std::optional<FrameSize> read_j2k(ByteReader& reader, std::int64_t begin, std::int64_t end) {
  begin = find_codestream(reader, begin, end);
  constexpr std::int64_t kHeader = 42;
  const std::uint8_t* bytes = begin + kHeader <= end ? reader.at(begin, kHeader) : nullptr;
  if (bytes == nullptr || long_word(bytes) != 0xff4fff51) return std::nullopt;
  const std::int64_t right = long_word(bytes + 8);
  const std::int64_t bottom = long_word(bytes + 12);
  const std::int64_t tile_width = std::max<std::int64_t>(1, long_word(bytes + 24));
  const std::int64_t tile_height = std::max<std::int64_t>(1, long_word(bytes + 28));
  const std::int64_t across = (right - long_word(bytes + 32) + tile_width - 1) / tile_width;
  const std::int64_t down = (bottom - long_word(bytes + 36) + tile_height - 1) / tile_height;
  return FrameSize{right - long_word(bytes + 16), bottom - long_word(bytes + 20), word(bytes + 40),
                   // Each factor is below 2^32 + 1; more tiles than that are too many in any case.
                   std::max<std::int64_t>(0, std::min<std::int64_t>(across, 1 << 24)) *
                       std::max<std::int64_t>(0, std::min<std::int64_t>(down, 1 << 24))};
}

}  // namespace

std::optional<FrameSize> read_frame_size(FrameCoding coding, ByteReader& reader, std::int64_t begin,
                                         std::int64_t end) {
  switch (coding) {
    case FrameCoding::jpeg:
    case FrameCoding::jpeg_ls:
      return read_jpeg(coding, reader, begin, end);
    case FrameCoding::jpeg_2000:
      return read_j2k(reader, begin, end);
    default:
      return std::nullopt;
  }
}

std::string frame_problem(FrameCoding coding, const std::optional<FrameSize>& size,
                          const FrameSize& expected) {
  if (coding == FrameCoding::rle || coding == FrameCoding::native) return {};
  const std::string_view what = coding == FrameCoding::jpeg_2000 ? "JPEG 2000 stream" : "JPEG stream";
  if (!size) return fmt::format("holds no {}", what);
  if (size->columns != expected.columns || size->rows != expected.rows) {
    return fmt::format("holds a {} of {} x {}, not {} x {} pixels", what, size->columns, size->rows,
                       expected.columns, expected.rows);
  }
  if (size->components != expected.components) {
    return fmt::format("holds a {} of {} components, not {}", what, size->components, expected.components);
  }
  if (size->tiles < 1 || size->tiles > kFewTiles + expected.rows * expected.columns / kSmallestTile) {
    return fmt::format("holds a {} of {} tiles", what, size->tiles);
  }
  return {};
}

}  // namespace tidemark::imaging
