#include "imaging/guard/dicom/pixel_extent.h"

#include <algorithm>

#include "core/checked.h"
#include "core/number_from.h"

namespace tidemark::imaging {
namespace {

constexpr DicomTag kSamplesPerPixel{0x0028, 0x0002};
constexpr DicomTag kPhotometricInterpretation{0x0028, 0x0004};
constexpr DicomTag kNumberOfFrames{0x0028, 0x0008};
constexpr DicomTag kRows{0x0028, 0x0010};
constexpr DicomTag kColumns{0x0028, 0x0011};
constexpr DicomTag kBitsAllocated{0x0028, 0x0100};

// An empty frame compresses well, but not better than this; beyond it the file claims more than it can hold.
constexpr std::int64_t kLargestCompression = 4096;

std::string_view without_blanks(std::string_view text) {
  constexpr std::string_view kPadding(" \0", 2);
  const std::size_t first = text.find_first_not_of(kPadding);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kPadding) - first + 1);
}

}  // namespace

PixelExtent::PixelExtent(const TransferSyntax& syntax)
    : syntax_(syntax), coding_{syntax.is_explicit, syntax.is_big_endian} {}

// A whole number in text (IS), or in 16 or 32 bits.
std::optional<std::int64_t> PixelExtent::number(const ElementHeader& header, ByteReader& reader) const {
  const std::uint8_t* bytes =
      header.length <= ByteReader::kMost ? reader.at(header.value, header.length) : nullptr;
  if (bytes == nullptr) return std::nullopt;
  if (header.tag == kNumberOfFrames || header.is("IS") || header.is("DS")) {
    return number_from<std::int64_t>(without_blanks({reinterpret_cast<const char*>(bytes), header.length}));
  }
  if (header.length == 2) return coding_.word(bytes);
  if (header.length == 4) return coding_.long_word(bytes);
  return std::nullopt;
}

void PixelExtent::note(const ElementHeader& header, ByteReader& reader, const Fragments* fragments) {
  if (header.tag == kRows) rows_ = number(header, reader);
  if (header.tag == kColumns) columns_ = number(header, reader);
  if (header.tag == kSamplesPerPixel) samples_ = number(header, reader);
  if (header.tag == kBitsAllocated) bits_ = number(header, reader);
  if (header.tag == kNumberOfFrames && header.length > 0) frames_ = number(header, reader);
  if (header.tag == kPhotometricInterpretation && header.length <= colours_.size()) {
    const std::uint8_t* bytes = reader.at(header.value, header.length);
    if (bytes != nullptr) std::copy(bytes, bytes + header.length, colours_.begin());
  }
  if (header.tag == kPixelData && !pixels_) {
    pixels_ = header;
    if (fragments == nullptr) return;
    fragments_ = *fragments;
    table_problem_ = check_table(reader, *fragments);
    frame_size_ =
        read_frame_size(syntax_.frames, reader, fragments->first, fragments->first + fragments->first_bytes);
  }
}

std::optional<std::int64_t> PixelExtent::needed() const {
  if (!rows_ || !columns_ || !samples_ || !bits_ || !frames_) return std::nullopt;
  const auto bits = checked_product(*rows_, *columns_, *samples_, *bits_, *frames_);
  if (!bits) return std::nullopt;
  const std::string_view colours = without_blanks({colours_.data(), colours_.size()});
  // Of these, neighbouring pixels share their colour (PS3.3 C.7.6.3.1.2).
  const bool is_halved = colours == "YBR_FULL_422" || colours == "YBR_PARTIAL_422";
  const std::int64_t shared = is_halved && *samples_ == 3 ? *bits / 3 * 2 : *bits;
  return shared / 8 + (shared % 8 != 0 ? 1 : 0);
}

// The table is empty or has an entry for each frame: where its first fragment's item begins (PS3.5 A.4).
PixelExtent::TableProblem PixelExtent::check_table(ByteReader& reader, const Fragments& fragments) {
  if (fragments.table_bytes == 0) return TableProblem::none;
  if (fragments.table_bytes % 4 != 0) return TableProblem::size;
  const std::int64_t entries = fragments.table_bytes / 4;
  if (entries > fragments.count) return TableProblem::count;
  constexpr ElementCoding kCoding{true, false};
  std::int64_t previous = -1;
  for (std::int64_t entry = 0; entry < entries; ++entry) {
    const std::uint8_t* bytes = reader.at(fragments.table + 4 * entry, 4);
    if (bytes == nullptr) return TableProblem::size;
    const std::int64_t offset = kCoding.long_word(bytes);
    if (offset <= previous || (entry == 0 && offset != 0) || fragments.begin + offset >= fragments.end) {
      return TableProblem::entry;
    }
    previous = offset;
  }
  return TableProblem::none;
}

std::string PixelExtent::native_problem() const {
  const auto bytes = needed();
  const std::int64_t held = pixels_->length;
  if (!bytes) return {};
  if (held == *bytes || held == *bytes + *bytes % 2) return {};
  const std::string frames = *frames_ == 1 ? "" : fmt::format("{} frames of ", *frames_);
  const std::string samples = *samples_ == 1 ? "" : fmt::format("{} x ", *samples_);
  return fmt::format("holds {} bytes where {}{} x {} pixels of {}{} bits need {}", held, frames, *columns_,
                     *rows_, samples, *bits_, *bytes);
}

std::string PixelExtent::compressed_problem(std::int64_t file_size) const {
  if (fragments_->count == 0) return "holds no compressed frame";
  if (frames_ && fragments_->count < *frames_) {
    return fmt::format("holds {} fragments for {} frames", fragments_->count, *frames_);
  }
  switch (table_problem_) {
    case TableProblem::none:
      break;
    case TableProblem::size:
      return fmt::format("has an offset table of {} bytes", fragments_->table_bytes);
    case TableProblem::count:
      return "has an offset table with more entries than there are fragments";
    case TableProblem::entry:
      return "has an offset table that does not point at its fragments";
  }
  if (frames_ && fragments_->table_bytes > 0 && fragments_->table_bytes / 4 != *frames_) {
    return fmt::format("has an offset table of {} entries for {} frames", fragments_->table_bytes / 4,
                       *frames_);
  }
  if (const auto bytes = needed(); bytes && *bytes / kLargestCompression > file_size) {
    return fmt::format("cannot hold {} x {} pixels in a file of {} bytes", *columns_, *rows_, file_size);
  }
  if (!rows_ || !columns_) return {};
  const std::int64_t components = samples_.value_or(frame_size_ ? frame_size_->components : 1);
  return frame_problem(syntax_.frames, frame_size_, {*columns_, *rows_, components});
}

std::string PixelExtent::problem(std::int64_t file_size) const {
  if (!pixels_) return {};
  return syntax_.is_encapsulated() ? compressed_problem(file_size) : native_problem();
}

}  // namespace tidemark::imaging
