// The pixels inside in a segmentation's frames. Private to this folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "core/result.h"
#include "imaging/dicom/frame_table.h"
#include "imaging/dicom/parsed_dicom.h"

namespace tidemark::imaging {

struct SegmentPixelFormat {
  std::int64_t frames = 0;
  std::int64_t rows = 0;
  std::int64_t columns = 0;
  int bits = 1;                   // a pixel: 1 or 8
  std::uint8_t least_inside = 1;  // of the values of pixels of 8 bits
};

// Compressed frames are decoded one by one: all together may be thousands of times as large as their file.
class SegmentPixels {
 public:
  // Checks that PixelData holds what the format says. `object` must outlive this. Fails (ErrorKind::input)
  // naming the file.
  static Result<SegmentPixels> open(const ParsedDicom& object, const SegmentPixelFormat& format,
                                    const std::filesystem::path& file);

  // Makes it the frame that is asked about. Fails likewise.
  Status go_to(std::int64_t frame);
  // As stored; 0 or 1, where a pixel has one bit.
  [[nodiscard]] int value(std::int64_t row, std::int64_t column) const {
    const auto n = static_cast<std::size_t>(first_ + row * format_.columns + column);
    return format_.bits == 1 ? bytes_[n / 8] >> n % 8 & 1 : bytes_[n];
  }
  [[nodiscard]] bool is_inside(std::int64_t row, std::int64_t column) const {
    return value(row, column) >= (format_.bits == 1 ? 1 : format_.least_inside);
  }

 private:
  SegmentPixels(const ParsedDicom& object, const SegmentPixelFormat& format, std::filesystem::path file)
      : object_(&object), format_(format), file_(std::move(file)) {}
  Status find_native();
  Status find_compressed();
  Status decode(std::int64_t frame);
  [[nodiscard]] tl::unexpected<Error> refuse(std::string_view what) const;

  const ParsedDicom* object_;
  SegmentPixelFormat format_;
  std::filesystem::path file_;
  FrameTable table_;                     // of compressed frames
  std::vector<std::uint8_t> decoded_;    // the frame that is asked about, if it was compressed
  std::span<const std::uint8_t> bytes_;  // that frame, or all of them
  std::int64_t first_ = 0;               // its first pixel in these
};

}  // namespace tidemark::imaging
