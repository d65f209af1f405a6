#include "imaging/dicom/pixels.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "imaging/dicom/dicom_setup.h"
#include "imaging/dicom/frame_codec.h"
#include "imaging/guard/dicom/frame_header.h"
#include "imaging/guard/guarded.h"

namespace tidemark::imaging {
namespace {

namespace fs = std::filesystem;

// Takes the stored bits out of words and extends their sign.
class BitReader {
 public:
  explicit BitReader(const SliceHeader& header)
      : shift_(header.high_bit + 1 - header.bits_stored),
        mask_(static_cast<std::uint32_t>((std::uint64_t{1} << header.bits_stored) - 1)),
        sign_(header.is_signed ? std::uint32_t{1} << (header.bits_stored - 1) : 0),
        word_mask_(static_cast<std::uint32_t>((std::uint64_t{1} << header.bits_allocated) - 1)) {}

  // Unsigned values of 32 bits stay in their low 32 bits; the caller looks at them. Without branches, so that
  // several pixels are done at once.
  std::int32_t operator()(std::uint32_t word) {
    const std::uint32_t bits = word >> shift_ & mask_;
    const std::uint32_t value = (bits ^ sign_) - sign_;  // extends the sign
    // A sign extended over the word is as good as clean.
    const std::uint32_t clean = bits << shift_;
    const std::uint32_t extended = value << shift_ & word_mask_;
    ignored_ |= static_cast<std::uint32_t>(word != clean) & static_cast<std::uint32_t>(word != extended);
    return static_cast<std::int32_t>(value);
  }
  [[nodiscard]] bool ignored() const { return ignored_ != 0; }

 private:
  int shift_;
  std::uint32_t mask_;
  std::uint32_t sign_;
  std::uint32_t word_mask_;
  std::uint32_t ignored_ = 0;
};

// `word(p)` gives the word of pixel p.
template <class Word>
FramePixels take_stored(const SliceHeader& header, const Word& word) {
  FramePixels pixels;
  pixels.stored.resize(static_cast<std::size_t>(header.frame_rows * header.frame_columns));
  BitReader read(header);
  for (std::size_t p = 0; p < pixels.stored.size(); ++p) pixels.stored[p] = read(word(p));
  pixels.ignored_bits = read.ignored();
  return pixels;
}

class HeldBytes : public ByteSource {
 public:
  explicit HeldBytes(std::vector<std::uint8_t> bytes) : held_(std::move(bytes)), view_(held_) {}
  [[nodiscard]] std::int64_t size() const override { return view_.size(); }
  std::size_t read(std::int64_t offset, std::span<std::uint8_t> room) override {
    return view_.read(offset, room);
  }

 private:
  std::vector<std::uint8_t> held_;
  MemoryBytes view_;
};

std::int64_t bytes_of_frame(const SliceHeader& header) {
  return header.frame_rows * header.frame_columns * (header.bits_allocated / 8);
}

}  // namespace

const SliceHeader* FrameReader::slice(std::int64_t frame, std::int64_t tile) const {
  const auto index = static_cast<std::size_t>(frame * slices_.front().tiles + tile);
  if (frame < 0 || tile < 0 || tile >= slices_.front().tiles || index >= slices_.size()) return nullptr;
  return &slices_[index];
}

// The begin of messages.
std::string FrameReader::where(std::int64_t frame) const {
  const std::string file = slices_.front().file.string();
  if (frames() == 1) return file + ": PixelData (7FE0,0010)";
  return fmt::format("{}: PixelData (7FE0,0010), frame {},", file, frame + 1);
}

// A deflated dataset can be read forward only; its inflated bytes are kept.
Status FrameReader::inflate(const Preflight& checked) {
  const auto size = InflatedBytes::measure(*bytes_, checked.dataset, kLargestInflation);
  if (!size) return fail(ErrorKind::input, "{}: {}", slices_.front().file.string(), size.error().message);
  std::vector<std::uint8_t> held(static_cast<std::size_t>(*size));
  InflatedBytes inflated(*bytes_, checked.dataset, *size);
  held.resize(inflated.read(0, held));
  bytes_ = std::make_unique<HeldBytes>(std::move(held));
  return {};
}

Status FrameReader::find_frames(ImageFile image) {
  slices_ = std::move(image.slices);
  syntax_ = image.checked.syntax;
  bytes_ = std::move(image.bytes);
  if (const SliceHeader& first = slices_.front(); !first.problem.empty()) {
    return fail(ErrorKind::input, "{}: {}", first.file.string(), first.problem);
  }
  if (!image.checked.pixels) {
    return fail(ErrorKind::input, "{}: PixelData (7FE0,0010) is missing", slices_.front().file.string());
  }
  pixels_ = *image.checked.pixels;
  if (syntax_->is_deflated) return inflate(image.checked);
  if (!image.checked.fragments) return {};
  auto table = FrameTable::read(*image.checked.fragments, syntax_->frames, *bytes_, frames());
  if (!table) {
    return fail(ErrorKind::input, "{}: PixelData (7FE0,0010) {}", slices_.front().file.string(),
                table.error());
  }
  table_ = std::move(*table);
  return {};
}

Result<FrameReader> FrameReader::open(const fs::path& file) {
  return guarded(file, [&]() -> Result<FrameReader> {
    TIDEMARK_TRY(set_up_dicom());
    auto image = open_image(file);
    if (!image) return tl::unexpected<Error>(std::move(image.error()));
    FrameReader reader;
    TIDEMARK_TRY(reader.find_frames(std::move(*image)));
    return reader;
  });
}

// Words are in the byte order of the transfer syntax, unless the pixels are said to be bytes (OB).
bool FrameReader::is_big_endian() const {
  return syntax_->is_big_endian && !pixels_.is("OB");
}

// Straight from the file. 8-bit pixels in words of 16 bits lie two to a word, the first in its low byte.
Result<FramePixels> FrameReader::decode_native(std::int64_t frame) const {
  const SliceHeader& header = slices_.front();
  const std::int64_t size = bytes_of_frame(header);
  const bool are_swapped = is_big_endian() && header.bits_allocated == 8;
  const std::int64_t begin = frame * size;
  const std::int64_t first = are_swapped ? begin / 2 * 2 : begin;
  const std::int64_t end = are_swapped ? (begin + size + 1) / 2 * 2 : begin + size;
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(end - first));
  if (end > pixels_.length || bytes_->read(pixels_.value + first, bytes) != bytes.size()) {
    return fail(ErrorKind::input, "{} ends early", where(frame));
  }
  const ElementCoding coding{true, is_big_endian()};
  if (header.bits_allocated == 16) {
    return take_stored(header, [&](std::size_t p) { return coding.word(&bytes[2 * p]); });
  }
  if (header.bits_allocated == 32) {
    return take_stored(header, [&](std::size_t p) { return coding.long_word(&bytes[4 * p]); });
  }
  const auto skipped = static_cast<std::size_t>(begin - first);
  const std::size_t swap = are_swapped ? 1 : 0;
  return take_stored(header, [&](std::size_t p) { return bytes[(p + skipped) ^ swap]; });
}

// Of a frame whose own size is the image's.
Result<std::vector<std::vector<std::uint8_t>>> FrameReader::read_fragments(std::int64_t frame) const {
  const SliceHeader& header = slices_.front();
  std::vector<std::vector<std::uint8_t>> fragments;
  for (const FramePiece& piece : table_.frame(frame)) {
    auto& fragment = fragments.emplace_back(static_cast<std::size_t>(piece.length));
    if (bytes_->read(piece.offset, fragment) != fragment.size()) {
      return fail(ErrorKind::input, "{} ends early", where(frame));
    }
  }
  MemoryBytes first(fragments.front());
  ByteReader reader(first);
  const auto size = read_frame_size(syntax_->frames, reader, 0, first.size());
  const std::string problem =
      frame_problem(syntax_->frames, size, {header.frame_columns, header.frame_rows, 1});
  if (!problem.empty()) return fail(ErrorKind::input, "{} {}", where(frame), problem);
  return fragments;
}

Result<FramePixels> FrameReader::decode_compressed(std::int64_t frame) const {
  const SliceHeader& header = slices_.front();
  auto fragments = read_fragments(frame);
  if (!fragments) return pass_on(fragments);
  const auto words = decode_fragments(*fragments, *syntax_, header);
  if (!words) return fail(ErrorKind::input, "{} {}", where(frame), words.error());
  return take_stored(header, [&](std::size_t p) { return (*words)[p]; });
}

Result<FramePixels> FrameReader::decode(std::int64_t frame) const {
  return guarded(slices_.front().file, [&]() -> Result<FramePixels> {
    if (frame < 0 || frame >= frames()) {
      return fail(ErrorKind::input, "{}: has no frame {}", slices_.front().file.string(), frame + 1);
    }
    auto pixels = syntax_->is_encapsulated() ? decode_compressed(frame) : decode_native(frame);
    if (!pixels) return pixels;
    const SliceHeader& header = slices_.front();
    const bool may_wrap = header.bits_stored == 32 && !header.is_signed;
    if (may_wrap && *std::min_element(pixels->stored.begin(), pixels->stored.end()) < 0) {
      return fail(ErrorKind::input, "{} holds values above {}", where(frame),
                  std::numeric_limits<std::int32_t>::max());
    }
    return pixels;
  });
}

bool FrameReader::has_words(bool is_signed) const {
  const SliceHeader& header = slices_.front();
  const bool fits = header.is_signed ? is_signed : !is_signed || header.bits_stored < 16;
  const bool is_ours =
      syntax_->is_encapsulated() || is_big_endian() == (std::endian::native == std::endian::big);
  return header.bits_allocated == 16 && fits && is_ours;
}

Status FrameReader::take_words(std::int64_t frame, std::span<std::uint16_t> target) const {
  const SliceHeader& header = slices_.front();
  const std::int64_t size = bytes_of_frame(header);
  if (frame < 0 || frame >= frames() || static_cast<std::int64_t>(target.size_bytes()) != size) {
    return fail(ErrorKind::input, "{}: has no frame {}", header.file.string(), frame + 1);
  }
  if (syntax_->is_encapsulated()) {
    auto fragments = read_fragments(frame);
    if (!fragments) return pass_on(fragments);
    const std::string problem = decode_words(*fragments, *syntax_, header, target);
    if (!problem.empty()) return fail(ErrorKind::input, "{} {}", where(frame), problem);
    return {};
  }
  const std::span bytes(reinterpret_cast<std::uint8_t*>(target.data()), target.size_bytes());
  const bool is_there = (frame + 1) * size <= pixels_.length;
  if (!is_there || bytes_->read(pixels_.value + frame * size, bytes) != bytes.size()) {
    return fail(ErrorKind::input, "{} ends early", where(frame));
  }
  return {};
}

Result<bool> FrameReader::read_words(std::int64_t frame, std::span<std::uint16_t> target) const {
  return guarded(slices_.front().file, [&]() -> Result<bool> {
    TIDEMARK_TRY(take_words(frame, target));
    if (slices_.front().bits_stored == 16) return false;
    BitReader read(slices_.front());
    for (std::uint16_t& word : target) word = static_cast<std::uint16_t>(read(word));
    return read.ignored();
  });
}

Result<DecodedFrame> decode_frame(const fs::path& file, std::int64_t frame) {
  auto reader = FrameReader::open(file);
  if (!reader) return pass_on(reader);
  auto pixels = reader->decode(frame);
  if (!pixels) return pass_on(pixels);
  return DecodedFrame{*reader->slice(frame, 0), std::move(*pixels)};
}

}  // namespace tidemark::imaging
