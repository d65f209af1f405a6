#include "imaging/dicom/media_directory.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "imaging/dicom/checked_dicom.h"
#include "imaging/dicom/detect.h"
#include "imaging/dicom/dicom_setup.h"

namespace tidemark::imaging {
namespace {

namespace fs = std::filesystem;

// A name as it is compared: small letters, without version number and last point.
std::string folded(std::string name) {
  if (const std::size_t version = name.rfind(';'); version != std::string::npos) {
    const bool is_number = name.find_first_not_of("0123456789", version + 1) == std::string::npos;
    if (is_number) name.erase(version);
  }
  if (name.ends_with('.')) name.pop_back();
  for (char& c : name) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return name;
}

// Finds files by what really lies in the folders, so that no name leads out of them.
class Medium {
 public:
  explicit Medium(fs::path root) : root_(std::move(root)) {}

  std::optional<fs::path> find(const std::vector<std::string>& components) {
    fs::path at = root_;
    for (const std::string& component : components) {
      const auto& names = listing(at);
      const auto entry = names.find(folded(component));
      if (entry == names.end()) return std::nullopt;
      at = entry->second;
    }
    std::error_code error;
    if (components.empty() || !fs::is_regular_file(fs::symlink_status(at, error))) return std::nullopt;
    return at;
  }

 private:
  using Listing = std::map<std::string, fs::path>;

  const Listing& listing(const fs::path& folder) {
    const auto [known, is_new] = listings_.try_emplace(folder);
    if (!is_new) return known->second;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
      std::error_code ignored;
      if (entry->is_symlink(ignored)) continue;
      fs::path& place = known->second[folded(entry->path().filename().string())];
      if (place.empty() || entry->path() < place) place = entry->path();
    }
    return known->second;
  }

  fs::path root_;
  std::map<fs::path, Listing> listings_;
};

// The components of ReferencedFileID, without the blanks that pad them.
std::vector<std::string> components_of(std::string_view value) {
  std::vector<std::string> components;
  while (!value.empty()) {
    const std::size_t end = std::min(value.find('\\'), value.size());
    std::string_view one = value.substr(0, end);
    while (!one.empty() && one.front() == ' ') one.remove_prefix(1);
    while (!one.empty() && one.back() == ' ') one.remove_suffix(1);
    components.emplace_back(one);
    value.remove_prefix(std::min(end + 1, value.size()));
  }
  return components;
}

// Control characters would spoil a message.
std::string shown(const std::vector<std::string>& components) {
  constexpr std::size_t kLongest = 100;
  std::string name;
  for (const std::string& one : components) name += (name.empty() ? "" : "/") + one;
  name.resize(std::min(name.size(), kLongest));
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return c < 0x20 || c > 0x7e; }, '?');
  return name;
}

// What is kept of a record, however long its values are.
struct Record {
  std::string type;        // (0004,1430)
  std::string series_uid;  // (0020,000E)
  std::string file_id;     // (0004,1500)
  bool is_named_whole = true;
};

// The value's first bytes without its padding.
std::string first_bytes(const ElementHeader& header, ByteReader& reader, std::size_t most) {
  std::string value;
  const std::size_t count = std::min<std::size_t>(header.length, most);
  while (value.size() < count) {
    const std::size_t step = std::min(ByteReader::kMost, count - value.size());
    const std::uint8_t* bytes = reader.at(header.value + static_cast<std::int64_t>(value.size()), step);
    if (bytes == nullptr) break;
    value.append(reinterpret_cast<const char*>(bytes), step);
  }
  value.erase(std::min(value.find('\0'), value.size()));
  value.erase(value.find_last_not_of(' ') + 1);
  value.erase(0, value.find_first_not_of(' '));
  return value;
}

// Takes the records as the walk over the tags comes to them, one at a time: none is kept. They stand in their
// order in the file; the offsets by which they also refer to each other are not followed.
class RecordReader {
 public:
  RecordReader(const fs::path& folder, std::int64_t size, const Progress& progress)
      : medium_(folder), size_(size), progress_(progress) {}

  // False when it is to go no further.
  bool observe(const ElementHeader& header, ByteReader& reader, const TagPlace& place) {
    if (place.depth == 0 && header.tag == kRecords) has_records_ = true;
    if (place.depth != 1 || place.sequence != kRecords) return true;
    if (place.item != item_) {
      finish();
      item_ = place.item;
      if (records_++ % kRecordsBetweenReports == 0) {
        if (progress_.cancelled()) return false;
        const auto done =
            static_cast<double>(header.begin) / static_cast<double>(std::max<std::int64_t>(size_, 1));
        progress_(std::min(1.0, done), "reading the medium's directory");
      }
    }
    constexpr std::size_t kLongestUid = 64;
    if (header.tag == kRecordType) record_.type = first_bytes(header, reader, 16);
    if (header.tag == kSeriesUid) record_.series_uid = first_bytes(header, reader, kLongestUid);
    if (header.tag == kFileId) {
      record_.file_id = first_bytes(header, reader, kLongestFileId);
      record_.is_named_whole = header.length <= kLongestFileId;
    }
    return true;
  }

  // Once the walk is done.
  MediaDirectory take() {
    finish();
    return std::move(directory_);
  }
  [[nodiscard]] bool has_records() const { return has_records_; }

 private:
  static constexpr DicomTag kRecords{0x0004, 0x1220};
  static constexpr DicomTag kRecordType{0x0004, 0x1430};
  static constexpr DicomTag kFileId{0x0004, 0x1500};
  static constexpr DicomTag kSeriesUid{0x0020, 0x000e};
  static constexpr std::int64_t kRecordsBetweenReports = 256;
  // Eight components of eight characters by the standard (PS3.10 8.2); names on disks are longer.
  static constexpr std::size_t kLongestFileId = 1024;
  static constexpr std::size_t kMostNames = 3;  // that list_missing() says
  static constexpr std::size_t kMostSeries = 10'000;

  void finish() {
    const Record record = std::exchange(record_, {});
    if (record.type.starts_with("SERIES")) series_uid_ = record.series_uid;
    if (record.type.starts_with("PATIENT") || record.type.starts_with("STUDY")) series_uid_.clear();
    if (record.file_id.empty()) return;
    const std::vector<std::string> components = components_of(record.file_id);
    const auto file = record.is_named_whole ? medium_.find(components) : std::nullopt;
    if (file) {
      if (seen_.insert(*file).second) directory_.files.push_back(*file);
      return;
    }
    note_missing(directory_.missing, components);
    auto& of_series = directory_.missing_of_series;
    if (of_series.size() < kMostSeries || of_series.contains(series_uid_)) {
      note_missing(of_series[series_uid_], components);
    }
  }

  static void note_missing(MissingFiles& missing, const std::vector<std::string>& components) {
    if (missing.first_names.size() < kMostNames) missing.first_names.push_back(shown(components));
    ++missing.count;
  }

  Medium medium_;
  std::int64_t size_;
  const Progress& progress_;
  MediaDirectory directory_;
  std::set<fs::path> seen_;
  std::string series_uid_;  // of the last record of a series
  Record record_;
  std::int64_t item_ = -1;  // offset of the record's item
  std::int64_t records_ = 0;
  bool has_records_ = false;
};

}  // namespace

bool is_media_directory(const fs::path& file) {
  return folded(file.filename().string()) == "dicomdir";
}

Result<MediaDirectory> read_media_directory(const fs::path& file, const Progress& progress) {
  TIDEMARK_TRY(set_up_dicom());  // for the names of tags in messages
  auto bytes = FileBytes::open(file);
  if (!bytes) return pass_on(bytes);
  if (!begins_as_dicom(*bytes)) return fail(ErrorKind::input, "{}: is not a DICOM file", file.string());
  RecordReader records(file.has_parent_path() ? file.parent_path() : fs::path("."), bytes->size(), progress);
  const Preflight checked =
      walk_dicom(*bytes, [&](const ElementHeader& header, ByteReader& reader, const TagPlace& place) {
        return records.observe(header, reader, place);
      });
  if (progress.cancelled()) return cancelled_error();
  if (!checked.may_be_parsed()) return fail(ErrorKind::input, "{}: {}", file.string(), describe(checked));
  if (!records.has_records()) {
    return fail(ErrorKind::input, "{}: DirectoryRecordSequence (0004,1220) is missing", file.string());
  }
  return records.take();
}

std::string list_missing(const MissingFiles& missing) {
  const bool are_all_named = missing.count <= static_cast<std::int64_t>(missing.first_names.size());
  const std::size_t named = missing.first_names.size() - (are_all_named ? 0 : 1);
  std::string text;
  for (std::size_t i = 0; i < named; ++i) text += (i == 0 ? "" : ", ") + missing.first_names[i];
  if (!are_all_named) text += fmt::format(" and {} more", missing.count - static_cast<std::int64_t>(named));
  return text;
}

}  // namespace tidemark::imaging
