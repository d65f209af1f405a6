#include "imaging/guard/zip_directory.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string_view>

namespace tidemark::imaging {
namespace {

constexpr std::uint32_t kEndMark = 0x06054b50;
constexpr std::uint32_t kLocatorMark = 0x07064b50;  // of the end with 64-bit numbers
constexpr std::uint32_t kLargeEndMark = 0x06064b50;
constexpr std::uint32_t kRecordMark = 0x02014b50;
constexpr std::uint32_t kEntryMark = 0x04034b50;
constexpr std::uint32_t kElsewhere = 0xffffffff;  // the number itself has 64 bits and stands elsewhere
constexpr std::int64_t kMostBytes = std::int64_t{64} << 20;  // of a directory
constexpr std::size_t kPiece = std::size_t{1} << 16;
constexpr std::int64_t kEntryHeader = 30;  // bytes before the entry's name

auto damaged(std::string_view why) {
  return fail(ErrorKind::input, "is damaged: {}", why);
}

// Little-endian numbers in a record of known length.
class Numbers {
 public:
  explicit Numbers(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  [[nodiscard]] std::uint16_t word(std::size_t at) const { return static_cast<std::uint16_t>(number(at, 2)); }
  [[nodiscard]] std::uint32_t long_word(std::size_t at) const {
    return static_cast<std::uint32_t>(number(at, 4));
  }
  // -1 where it is beyond what a size can be.
  [[nodiscard]] std::int64_t large(std::size_t at) const {
    return std::max<std::int64_t>(-1, static_cast<std::int64_t>(number(at, 8)));
  }

 private:
  [[nodiscard]] std::uint64_t number(std::size_t at, std::size_t count) const {
    std::uint64_t value = 0;
    for (std::size_t b = count; b-- > 0;) value = value << 8U | bytes_[at + b];
    return value;
  }
  std::span<const std::uint8_t> bytes_;
};

// Where the directory is.
struct Extent {
  std::int64_t begin = 0;
  std::int64_t bytes = 0;
  std::int64_t records = 0;
  bool is_large = false;  // else the number of records is what is left of it in 16 bits
};

// The end of the directory, the last one that the file's end has room for.
Result<Extent> find_directory(FileBytes& file) {
  constexpr std::int64_t kEnd = 22;
  constexpr std::int64_t kLocator = 20;
  constexpr std::int64_t kLongestComment = 65535;
  std::vector<std::uint8_t> tail(
      static_cast<std::size_t>(std::min(file.size(), kEnd + kLongestComment + kLocator)));
  const std::int64_t tail_begin = file.size() - static_cast<std::int64_t>(tail.size());
  if (file.read(tail_begin, tail) != tail.size()) return damaged("it cannot be read to its end");
  const Numbers numbers(tail);
  auto at = static_cast<std::int64_t>(tail.size()) - kEnd;
  while (at >= 0 && numbers.long_word(static_cast<std::size_t>(at)) != kEndMark) --at;
  if (at < 0) return damaged("its directory is missing");
  const auto end = static_cast<std::size_t>(at);
  Extent extent{numbers.long_word(end + 16), numbers.long_word(end + 12), numbers.word(end + 10), false};
  const bool is_large = extent.records == 0xffff || extent.begin == kElsewhere || extent.bytes == kElsewhere;
  if (is_large && at >= kLocator && numbers.long_word(end - kLocator) == kLocatorMark) {
    std::array<std::uint8_t, 56> whole{};
    const std::int64_t begin = numbers.large(end - kLocator + 8);
    if (begin < 0 || file.read(begin, whole) != whole.size()) return damaged("its directory is missing");
    const Numbers large(whole);
    if (large.long_word(0) != kLargeEndMark) return damaged("its directory is missing");
    extent = {large.large(48), large.large(40), large.large(32), true};
  }
  const std::int64_t most = tail_begin + at;
  if (extent.begin < 0 || extent.bytes < 0 || extent.begin > most || extent.bytes > most - extent.begin) {
    return damaged("its directory is not whole");
  }
  return extent;
}

// The 64-bit numbers of a record, in an extra field, for those that are kElsewhere.
void read_large(std::span<const std::uint8_t> extra, ZipRecord& record) {
  constexpr std::uint16_t kLarge = 1;
  while (extra.size() >= 4) {
    const Numbers numbers(extra);
    const std::size_t length = numbers.word(2);
    if (length > extra.size() - 4) return;
    std::size_t at = 4;
    for (std::int64_t* number : {&record.bytes, &record.packed, &record.begin}) {
      if (numbers.word(0) != kLarge || *number != kElsewhere || at + 8 > 4 + length) continue;
      *number = numbers.large(at);
      at += 8;
    }
    extra = extra.subspan(4 + length);
  }
}

Result<std::vector<ZipRecord>> parse(std::span<const std::uint8_t> bytes, std::int64_t most_entries) {
  constexpr std::size_t kFixed = 46;
  std::vector<ZipRecord> records;
  while (!bytes.empty()) {
    if (bytes.size() < kFixed) return damaged("its directory is cut off");
    const Numbers numbers(bytes);
    const std::size_t name = numbers.word(28);
    const std::size_t extra = numbers.word(30);
    const std::size_t length = kFixed + name + extra + numbers.word(32);
    if (numbers.long_word(0) != kRecordMark || length > bytes.size()) {
      return damaged("its directory is cut off");
    }
    if (static_cast<std::int64_t>(records.size()) >= most_entries) {
      return fail(ErrorKind::input, "has more than {} entries", most_entries);
    }
    ZipRecord& record = records.emplace_back();
    record.name.assign(reinterpret_cast<const char*>(bytes.data()) + kFixed, name);
    record.begin = numbers.long_word(42);
    record.packed = numbers.long_word(20);
    record.bytes = numbers.long_word(24);
    record.checksum = numbers.long_word(16);
    record.method = numbers.word(10);
    record.is_encrypted = (numbers.word(8) & 1U) != 0;
    read_large(bytes.subspan(kFixed + name, extra), record);
    bytes = bytes.subspan(length);
  }
  return records;
}

// Where each entry has to end. How long its second header is only that header says: unpacking looks at it.
Status bound_entries(std::vector<ZipRecord>& records, std::int64_t directory) {
  std::vector<std::reference_wrapper<ZipRecord>> in_file(records.begin(), records.end());
  std::sort(in_file.begin(), in_file.end(),
            [](const ZipRecord& a, const ZipRecord& b) { return a.begin > b.begin; });
  std::int64_t end = directory;
  for (ZipRecord& record : in_file) {
    record.end = end;
    const std::int64_t least = kEntryHeader + static_cast<std::int64_t>(record.name.size());
    if (record.begin > end || end - record.begin < least || end - record.begin - least < record.packed) {
      return damaged("its entries overlap");
    }
    end = record.begin;
  }
  return {};
}

Status hand_out(ByteSource& bytes, const ZipDirectory::Take& take) {
  std::vector<std::uint8_t> piece(kPiece);
  std::int64_t at = 0;
  while (const std::size_t got = bytes.read(at, piece)) {
    TIDEMARK_TRY(take(std::span(piece).first(got)));
    at += static_cast<std::int64_t>(got);
  }
  return {};
}

Status hand_out_inflated(ByteSource& packed, const ZipDirectory::Take& take) {
  InflatedBytes bytes(packed, 0, 0);
  TIDEMARK_TRY(hand_out(bytes, take));
  return bytes.ended();
}

}  // namespace

Status ZipDirectory::read_records(std::int64_t most_entries) {
  const auto extent = find_directory(file_);
  if (!extent) return pass_on(extent);
  if (extent->records > most_entries) {
    return fail(ErrorKind::input, "has {} entries, more than {}", extent->records, most_entries);
  }
  if (extent->bytes > kMostBytes) {
    return fail(ErrorKind::input, "has a directory of {} MB", extent->bytes >> 20);
  }
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(extent->bytes));
  if (file_.read(extent->begin, bytes) != bytes.size()) return damaged("it cannot be read");
  auto records = parse(bytes, most_entries);
  if (!records) return pass_on(records);
  const auto count = static_cast<std::int64_t>(records->size());
  if (count != extent->records && (extent->is_large || count % 0x10000 != extent->records)) {
    return damaged(fmt::format("its directory holds {} entries instead of {}", count, extent->records));
  }
  const auto is_within = [&](const ZipRecord& record) {
    return record.bytes >= 0 && record.packed >= 0 && record.begin >= 0 && record.begin <= file_.size() &&
           record.packed <= file_.size() - record.begin;
  };
  if (!std::all_of(records->begin(), records->end(), is_within)) {
    return damaged("an entry reaches beyond its end");
  }
  TIDEMARK_TRY(bound_entries(*records, extent->begin));
  records_ = std::move(*records);
  return {};
}

Result<ZipDirectory> ZipDirectory::read(FileBytes file, std::int64_t most_entries) {
  ZipDirectory directory(std::move(file));
  TIDEMARK_TRY(directory.read_records(most_entries));
  return directory;
}

Result<ZipDirectory> ZipDirectory::read(const std::filesystem::path& file, std::int64_t most_entries) {
  auto opened = FileBytes::open(file);
  if (!opened) return pass_on(opened);
  auto directory = read(std::move(*opened), most_entries);
  if (directory) return directory;
  return fail(directory.error().kind, "{}: {}", file.string(), directory.error().message);
}

Status ZipDirectory::unpack(const ZipRecord& record, const Take& take) {
  std::array<std::uint8_t, kEntryHeader> fixed{};
  if (file_.read(record.begin, fixed) != fixed.size() || Numbers(fixed).long_word(0) != kEntryMark) {
    return fail(ErrorKind::input, "is not where the directory says");
  }
  const std::int64_t begin = record.begin + kEntryHeader + Numbers(fixed).word(26) + Numbers(fixed).word(28);
  if (begin > record.end || record.packed > record.end - begin) {
    return fail(ErrorKind::input, "reaches into the next entry");
  }
  std::int64_t bytes = 0;
  uLong checksum = crc32(0, nullptr, 0);
  const Take counted = [&](std::span<const std::uint8_t> piece) -> Status {
    bytes += static_cast<std::int64_t>(piece.size());
    if (bytes > record.bytes) return fail(ErrorKind::input, "holds more than it says");
    checksum = crc32(checksum, piece.data(), static_cast<uInt>(piece.size()));
    return take(piece);
  };
  if (!record.is_readable()) {
    return fail(ErrorKind::input, "is compressed in a way that is not read (method {})", record.method);
  }
  ByteRange packed(file_, begin, record.packed);
  const Status done =
      record.method == ZipRecord::kStored ? hand_out(packed, counted) : hand_out_inflated(packed, counted);
  if (!done) return done;
  if (bytes != record.bytes) return fail(ErrorKind::input, "holds less than it says");
  if (checksum != record.checksum) return fail(ErrorKind::input, "its checksum is another one");
  return {};
}

}  // namespace tidemark::imaging
