#include "imaging/results/segment_pixels.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <utility>

#include "core/checked.h"
#include "imaging/dicom/frame_codec.h"
#include "imaging/guard/dicom/frame_header.h"

namespace tidemark::imaging {

namespace fs = std::filesystem;

namespace {
// The pixels of a compressed frame: a decoded one takes five bytes for each.
constexpr std::int64_t kLargestFrame = std::int64_t{1} << 24;
}  // namespace

tl::unexpected<Error> SegmentPixels::refuse(std::string_view what) const {
  return fail(ErrorKind::input, "{}: PixelData (7FE0,0010) {}", file_.string(), what);
}

Result<SegmentPixels> SegmentPixels::open(const ParsedDicom& object, const SegmentPixelFormat& format,
                                          const fs::path& file) {
  SegmentPixels pixels(object, format, file);
  const Status found = object.syntax().is_encapsulated() ? pixels.find_compressed() : pixels.find_native();
  if (!found) return pass_on(found);
  return pixels;
}

// As long as the file at most.
Status SegmentPixels::find_native() {
  DcmDataset& dataset = object_->dataset();
  const Uint8* bytes = nullptr;
  const Uint16* words = nullptr;
  unsigned long count = 0;
  if (dataset.findAndGetUint8Array(DCM_PixelData, bytes, &count).bad() &&
      dataset.findAndGetUint16Array(DCM_PixelData, words, &count).good()) {
    bytes = reinterpret_cast<const Uint8*>(words);  // little endian, in files and here
    count *= 2;
  }
  const auto needed = checked_product(format_.frames, format_.rows, format_.columns, format_.bits);
  if (bytes == nullptr || !needed ||
      *needed / 8 + (*needed % 8 != 0 ? 1 : 0) > static_cast<std::int64_t>(count)) {
    return refuse(fmt::format("holds less than {} frames of {} x {} pixels of {} bits", format_.frames,
                              format_.columns, format_.rows, format_.bits));
  }
  bytes_ = {bytes, count};
  return {};
}

Status SegmentPixels::find_compressed() {
  if (format_.rows * format_.columns > kLargestFrame) {
    return refuse(fmt::format("has compressed frames of {} x {} pixels, more than 16 million",
                              format_.columns, format_.rows));
  }
  const Preflight& checked = object_->checked();
  if (checked.verdict != Preflight::Verdict::good || !checked.fragments || format_.bits != 8) {
    return refuse("cannot be decoded");
  }
  auto table =
      FrameTable::read(*checked.fragments, object_->syntax().frames, object_->bytes(), format_.frames);
  if (!table) return refuse(table.error());
  table_ = std::move(*table);
  return {};
}

Status SegmentPixels::decode(std::int64_t frame) {
  std::vector<std::vector<std::uint8_t>> fragments;
  for (const FramePiece& piece : table_.frame(frame)) {
    auto& fragment = fragments.emplace_back(static_cast<std::size_t>(piece.length));
    if (object_->bytes().read(piece.offset, fragment) != fragment.size()) return refuse("ends early");
  }
  MemoryBytes first(fragments.front());
  ByteReader reader(first);
  const FrameCoding coding = object_->syntax().frames;
  const auto size = read_frame_size(coding, reader, 0, first.size());
  if (const auto problem = frame_problem(coding, size, {format_.columns, format_.rows, 1});
      !problem.empty()) {
    return refuse(problem);
  }
  SliceHeader header;
  header.frame_rows = header.rows = format_.rows;
  header.frame_columns = header.columns = format_.columns;
  header.bits_allocated = header.bits_stored = 8;
  header.high_bit = 7;
  const auto words = decode_fragments(fragments, object_->syntax(), header);
  if (!words) return refuse(words.error());
  decoded_.assign(words->begin(), words->end());
  bytes_ = decoded_;
  return {};
}

Status SegmentPixels::go_to(std::int64_t frame) {
  if (object_->syntax().is_encapsulated()) return decode(frame);
  first_ = frame * format_.rows * format_.columns;
  return {};
}

}  // namespace tidemark::imaging
