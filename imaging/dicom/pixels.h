// The values of the frames of one DICOM file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "core/result.h"
#include "imaging/dicom/frame_table.h"
#include "imaging/dicom/header_reader.h"

namespace tidemark::imaging {

struct FramePixels {
  std::vector<std::int32_t> stored;  // before rescale, i (along a row) fastest
  bool ignored_bits = false;         // bits outside BitsStored were set and have been cleared
};

// A file whose header has been read. Each frame is decoded by itself: of a file of many frames no more than
// one a thread is in memory. Only the inflated bytes of a deflated file are kept.
class FrameReader {
 public:
  // Fails (ErrorKind::input), naming the file, when the header has a problem, or when the file does not say
  // where its frames are.
  static Result<FrameReader> open(const std::filesystem::path& file);

  // Of each frame, or of each of its tiles.
  [[nodiscard]] const std::vector<SliceHeader>& slices() const { return slices_; }
  // Null when the file has no such slice.
  [[nodiscard]] const SliceHeader* slice(std::int64_t frame, std::int64_t tile) const;
  [[nodiscard]] std::int64_t frames() const { return slices_.front().frames; }

  // Values are taken from the bits that HighBit and BitsStored name and sign-extended by PixelRepresentation
  // (DICOM PS3.5 8.1.1). Fails (ErrorKind::input), naming the file, when the pixel data is damaged or not as
  // long as the header says. Several threads may decode at the same time.
  [[nodiscard]] Result<FramePixels> decode(std::int64_t frame) const;

  // Whether the frames are words of 16 bits in this machine's order, all of whose values are within those of
  // 16 bits with that sign.
  [[nodiscard]] bool has_words(bool is_signed) const;
  // The same values as decode() gives, of a file that has words, with no copy on the way that can be avoided:
  // `target` is as large as a frame. Returns whether bits outside BitsStored were set.
  [[nodiscard]] Result<bool> read_words(std::int64_t frame, std::span<std::uint16_t> target) const;

 private:
  FrameReader() = default;
  Status find_frames(ImageFile image);
  Status inflate(const Preflight& checked);
  [[nodiscard]] bool is_big_endian() const;
  Result<FramePixels> decode_native(std::int64_t frame) const;
  Result<FramePixels> decode_compressed(std::int64_t frame) const;
  Result<std::vector<std::vector<std::uint8_t>>> read_fragments(std::int64_t frame) const;
  Status take_words(std::int64_t frame, std::span<std::uint16_t> target) const;
  [[nodiscard]] std::string where(std::int64_t frame) const;

  std::vector<SliceHeader> slices_;
  std::unique_ptr<ByteSource> bytes_;
  const TransferSyntax* syntax_ = nullptr;
  ElementHeader pixels_;
  FrameTable table_;
};

// One frame of a file, and the header of (the first tile of) it. Fails as the functions above do.
struct DecodedFrame {
  SliceHeader header;
  FramePixels pixels;
};
[[nodiscard]] Result<DecodedFrame> decode_frame(const std::filesystem::path& file, std::int64_t frame = 0);

}  // namespace tidemark::imaging
