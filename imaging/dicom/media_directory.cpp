#include "imaging/dicom/media_directory.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include "imaging/dicom/dicom_setup.h"
#include "imaging/dicom/header_reader.h"
#include "imaging/dicom/transfer_syntaxes.h"

namespace tidemark {
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

std::string text_of(DcmItem& record, const DcmTagKey& key) {
  OFString value;
  if (record.findAndGetOFStringArray(key, value).bad()) return {};
  return {value.c_str(), value.size()};
}

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

MediaDirectory collect(DcmSequenceOfItems& records, const fs::path& folder) {
  MediaDirectory directory;
  Medium medium(folder);
  std::set<fs::path> seen;
  std::string series_uid;
  // Not by number: DCMTK counts from the first one each time.
  for (DcmObject* next = nullptr; (next = records.nextInContainer(next)) != nullptr;) {
    DcmItem& record = *static_cast<DcmItem*>(next);
    const std::string type = text_of(record, DCM_DirectoryRecordType);
    if (type.starts_with("SERIES")) series_uid = text_of(record, DCM_SeriesInstanceUID);
    if (type.starts_with("PATIENT") || type.starts_with("STUDY")) series_uid.clear();
    const std::string value = text_of(record, DCM_ReferencedFileID);
    if (value.empty()) continue;
    const std::vector<std::string> components = components_of(value);
    if (const auto file = medium.find(components)) {
      if (seen.insert(*file).second) directory.files.push_back(*file);
    } else {
      directory.missing.push_back({shown(components), series_uid});
    }
  }
  return directory;
}

}  // namespace

bool is_media_directory(const fs::path& file) {
  return folded(file.filename().string()) == "dicomdir";
}

Result<MediaDirectory> read_media_directory(const fs::path& file) {
  TIDEMARK_TRY(set_up_dicom());
  const auto syntax = syntax_to_parse(file);
  if (!syntax) return tl::unexpected<Error>(syntax.error());
  DcmFileFormat loaded;
  const OFCondition parsed =
      loaded.loadFile(file.c_str(), DcmXfer(std::string((*syntax)->uid).c_str()).getXfer());
  if (parsed.bad()) return fail(ErrorKind::input, "{}: is damaged: {}", file.string(), parsed.text());
  DcmSequenceOfItems* records = nullptr;
  if (loaded.getDataset()->findAndGetSequence(DCM_DirectoryRecordSequence, records).bad() ||
      records == nullptr) {
    return fail(ErrorKind::input, "{}: DirectoryRecordSequence (0004,1220) is missing", file.string());
  }
  return collect(*records, file.has_parent_path() ? file.parent_path() : fs::path("."));
}

std::string list_missing(const std::vector<MediaDirectory::Missing>& missing) {
  constexpr std::size_t kMost = 3;
  std::string text;
  const std::size_t named = missing.size() > kMost ? kMost - 1 : missing.size();
  for (std::size_t i = 0; i < named; ++i) text += (i == 0 ? "" : ", ") + missing[i].name;
  if (missing.size() > named) text += fmt::format(" and {} more", missing.size() - named);
  return text;
}

}  // namespace tidemark
