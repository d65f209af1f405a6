// The place of each frame in an image's pixel data.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "imaging/guard/dicom/tag_walk.h"
#include "imaging/guard/dicom/transfer_syntaxes.h"

namespace tidemark::imaging {

struct FramePiece {
  std::int64_t offset = 0;
  std::int64_t length = 0;
};

// The fragments of compressed frames. A frame is one fragment, or several.
class FrameTable {
 public:
  // Follows the offset table, or without one the number of fragments, or where a fragment begins a stream.
  // `fragments` have passed the preflight. The error is one line about PixelData.
  static tl::expected<FrameTable, std::string> read(const Fragments& fragments, FrameCoding coding,
                                                    ByteSource& bytes, std::int64_t frames);

  [[nodiscard]] std::span<const FramePiece> frame(std::int64_t index) const;

 private:
  bool follow_offsets(const Fragments& fragments, ByteReader& reader, std::int64_t frames);
  void follow_streams(FrameCoding coding, ByteReader& reader);

  std::vector<FramePiece> pieces_;
  std::vector<std::size_t> first_;  // piece of each frame
};

}  // namespace tidemark::imaging
