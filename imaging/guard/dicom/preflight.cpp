#include "imaging/guard/dicom/preflight.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include "imaging/guard/dicom/pixel_extent.h"

namespace tidemark::imaging {
namespace {

constexpr std::int64_t kMiB = std::int64_t{1} << 20;
constexpr std::int64_t kPreamble = 132;

constexpr DicomTag kTransferSyntax{0x0002, 0x0010};
constexpr DicomTag kSeriesInstanceUid{0x0020, 0x000e};

// A UID's 64 characters without their padding.
std::string uid_of(const ElementHeader& header, ByteReader& reader) {
  constexpr std::size_t kLongest = 64;
  const std::size_t length = std::min<std::size_t>(header.length, kLongest);
  const std::uint8_t* bytes = reader.at(header.value, length);
  if (bytes == nullptr) return {};
  std::string uid(reinterpret_cast<const char*>(bytes), length);
  uid.erase(std::find(uid.begin(), uid.end(), '\0'), uid.end());
  uid.erase(uid.find_last_not_of(' ') + 1);
  return uid;
}

// A UID for a message: a file may hold any bytes in its place.
std::string printable(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c > 0x7e; }, '?');
  return text;
}

// Of a dataset whose file does not say it: two capitals after the first tag are a value representation, and
// the first group is a small number.
const TransferSyntax* guess_syntax(ByteSource& bytes, std::int64_t begin) {
  std::array<std::uint8_t, 8> first{};
  bytes.read(begin, first);
  const auto is_capital = [](std::uint8_t c) { return c >= 'A' && c <= 'Z'; };
  const bool is_explicit = is_capital(first[4]) && is_capital(first[5]);
  const bool is_big_endian = first[0] == 0 && first[1] != 0;
  if (!is_explicit) return find_transfer_syntax(kImplicitLittleEndian);
  return find_transfer_syntax(is_big_endian ? kExplicitBigEndian : kExplicitLittleEndian);
}

class Check {
 public:
  // `most_bytes`: that a parser may take for the elements.
  Check(ByteSource& bytes, std::int64_t most_bytes, TagWalk::Observer observe)
      : bytes_(bytes), most_bytes_(most_bytes), observe_(std::move(observe)) {}

  Preflight run() {
    if (const auto dataset = read_meta()) {
      result_.dataset = *dataset;
      read_dataset(*dataset);
    }
    return std::move(result_);
  }

 private:
  void conclude(Preflight::Verdict verdict, TagDamage reason) {
    result_.verdict = verdict;
    result_.reason = std::move(reason);
  }

  // The file meta information. Returns where the dataset begins; nothing when damaged.
  std::optional<std::int64_t> read_meta() {
    std::array<std::uint8_t, kPreamble> start{};
    const bool has_preamble =
        bytes_.read(0, start) == start.size() && std::memcmp(start.data() + 128, "DICM", 4) == 0;
    std::string uid;
    bool is_named = false;
    TagWalk walk(bytes_, most_bytes_);
    const auto dataset = walk.walk_meta(has_preamble ? kPreamble : 0,
                                        [&](const auto& header, ByteReader& reader, const auto*) {
                                          if (header.tag != kTransferSyntax) return;
                                          uid = uid_of(header, reader);
                                          is_named = true;
                                          syntax_offset_ = header.begin;
                                        });
    if (!dataset) {
      conclude(Preflight::Verdict::damaged, dataset.error());
      return std::nullopt;
    }
    if (*dataset >= bytes_.size()) {
      conclude(Preflight::Verdict::damaged, {{}, *dataset, "is missing"});
      return std::nullopt;
    }
    // DCMTK would read it as more meta information.
    std::array<std::uint8_t, 2> group{};
    bytes_.read(*dataset, group);
    if (group[0] == 0x00 && group[1] == 0x02) {
      conclude(Preflight::Verdict::damaged,
               {{}, *dataset, "begins with group 0002 (big endian) or 0200 (little endian)"});
      return std::nullopt;
    }
    result_.syntax = is_named ? find_transfer_syntax(uid) : guess_syntax(bytes_, *dataset);
    if (result_.syntax != nullptr && result_.syntax->is_read) return *dataset;
    refuse_syntax(uid, *dataset);
    return std::nullopt;
  }

  // The series is named all the same, so that it does not seem whole without the file. Every syntax that is
  // not read is one of compressed pixels, whose datasets are written explicitly.
  void refuse_syntax(const std::string& uid, std::int64_t dataset) {
    static constexpr TransferSyntax kOther{
        .uid = {}, .name = {}, .is_read = false, .frames = FrameCoding::rle};
    const std::string name = result_.syntax != nullptr ? fmt::format(" ({})", result_.syntax->name) : "";
    result_.syntax = &kOther;
    walk_dataset(bytes_, dataset);
    result_.syntax = nullptr;
    conclude(
        Preflight::Verdict::unknown_syntax,
        {kTransferSyntax, syntax_offset_, fmt::format("is {}{}, which is not read", printable(uid), name)});
  }

  void read_dataset(std::int64_t begin) {
    if (!result_.syntax->is_deflated) return walk_dataset(bytes_, begin);
    const auto size = InflatedBytes::measure(bytes_, begin, kLargestInflation);
    if (!size) return conclude(Preflight::Verdict::damaged, {{}, begin, size.error().message});
    InflatedBytes inflated(bytes_, begin, *size);
    walk_dataset(inflated, 0);
  }

  void walk_dataset(ByteSource& bytes, std::int64_t begin) {
    const TransferSyntax& syntax = *result_.syntax;
    PixelExtent extent(syntax);
    TagWalk walk(bytes, most_bytes_);
    const auto visit = [&](const ElementHeader& header, ByteReader& reader, const Fragments* fragments) {
      if (header.tag == kSeriesInstanceUid && result_.series_uid.empty()) {
        result_.series_uid = uid_of(header, reader);
      }
      extent.note(header, reader, fragments);
      if (header.tag == kPixelData && !result_.pixels) {
        result_.pixels = header;
        if (fragments != nullptr) result_.fragments = *fragments;
      }
    };
    const auto walked = walk.walk_dataset(begin, {syntax.is_explicit, syntax.is_big_endian},
                                          syntax.is_encapsulated(), visit, observe_);
    if (!walked) {
      conclude(Preflight::Verdict::damaged, walked.error());
    } else if (auto problem = extent.problem(bytes_.size()); !problem.empty()) {
      conclude(Preflight::Verdict::bad_pixels, {kPixelData, extent.offset(), std::move(problem)});
    }
  }

  ByteSource& bytes_;
  std::int64_t most_bytes_;
  TagWalk::Observer observe_;
  std::int64_t syntax_offset_ = 0;
  Preflight result_;
};

}  // namespace

Preflight preflight_dicom(ByteSource& bytes) {
  return Check(bytes, 64 * kMiB + bytes.size(), {}).run();
}

Preflight walk_dicom(ByteSource& bytes, const TagWalk::Observer& observe) {
  return Check(bytes, std::numeric_limits<std::int64_t>::max(), observe).run();
}

}  // namespace tidemark::imaging
