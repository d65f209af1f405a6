#include "imaging/dicom/frame_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace tidemark::imaging {
namespace {

constexpr ElementCoding kItems{false, false};
constexpr std::int64_t kItemHeader = 8;

std::vector<FramePiece> read_pieces(const Fragments& fragments, ByteReader& reader) {
  std::vector<FramePiece> pieces;
  std::int64_t at = fragments.begin;
  while (at + kItemHeader <= fragments.end) {
    const std::uint8_t* header = reader.at(at, kItemHeader);
    if (header == nullptr) break;
    const std::int64_t length = kItems.long_word(header + 4);
    if (length > 0) pieces.push_back({at + kItemHeader, length});
    at += kItemHeader + length;
  }
  return pieces;
}

constexpr std::size_t kLongestMark = 8;

// Whether these are the first bytes of a stream of its own: SOI, SOC and SIZ, or the signature box of a JP2
// file.
bool begins_stream(FrameCoding coding, const std::uint8_t* bytes) {
  using namespace std::string_view_literals;
  const std::string_view start(reinterpret_cast<const char*>(bytes), kLongestMark);
  if (coding != FrameCoding::jpeg_2000) return start.starts_with("\xff\xd8"sv);
  return start.starts_with("\xff\x4f\xff\x51"sv) || start == "\0\0\0\x0cjP  "sv;
}

}  // namespace

bool FrameTable::follow_offsets(const Fragments& fragments, ByteReader& reader, std::int64_t frames) {
  if (fragments.table_bytes != 4 * frames) return false;
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    const std::uint8_t* entry = reader.at(fragments.table + 4 * frame, 4);
    if (entry == nullptr) return false;
    const std::int64_t offset = fragments.begin + kItems.long_word(entry) + kItemHeader;
    const auto piece = std::lower_bound(pieces_.begin(), pieces_.end(), offset,
                                        [](const FramePiece& p, std::int64_t o) { return p.offset < o; });
    if (piece == pieces_.end() || piece->offset != offset) return false;
    first_.push_back(static_cast<std::size_t>(piece - pieces_.begin()));
  }
  return true;
}

void FrameTable::follow_streams(FrameCoding coding, ByteReader& reader) {
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    const std::uint8_t* bytes = reader.at(pieces_[p].offset, kLongestMark);
    if (bytes != nullptr && begins_stream(coding, bytes)) first_.push_back(p);
  }
}

tl::expected<FrameTable, std::string> FrameTable::read(const Fragments& fragments, FrameCoding coding,
                                                       ByteSource& bytes, std::int64_t frames) {
  ByteReader reader(bytes);
  FrameTable table;
  table.pieces_ = read_pieces(fragments, reader);
  const auto pieces = static_cast<std::int64_t>(table.pieces_.size());
  if (frames == 1) {
    table.first_.push_back(0);
  } else if (fragments.table_bytes > 0) {
    if (!table.follow_offsets(fragments, reader, frames)) {
      return tl::unexpected<std::string>("has an offset table that does not point at its fragments");
    }
  } else if (pieces == frames) {
    for (std::size_t p = 0; p < table.pieces_.size(); ++p) table.first_.push_back(p);
  } else if (coding != FrameCoding::rle) {
    table.follow_streams(coding, reader);
  }
  const bool is_complete =
      static_cast<std::int64_t>(table.first_.size()) == frames && table.first_.front() == 0 && pieces > 0;
  if (!is_complete) {
    return tl::unexpected(fmt::format(
        "holds {} fragments for {} frames, and does not say which belong together", pieces, frames));
  }
  table.first_.push_back(table.pieces_.size());
  return table;
}

std::span<const FramePiece> FrameTable::frame(std::int64_t index) const {
  const auto frame = static_cast<std::size_t>(index);
  return std::span(pieces_).subspan(first_.at(frame), first_.at(frame + 1) - first_.at(frame));
}

}  // namespace tidemark::imaging
