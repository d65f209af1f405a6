#include "imaging/archive/study_archive.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <map>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "imaging/guard/zip_directory.h"

namespace tidemark::imaging {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kGiB = std::int64_t{1} << 30;
// What is left free of the disk.
constexpr std::int64_t kReserve = std::int64_t{256} << 20;
// Archives within an archive; the others are counted.
constexpr std::int64_t kMostNamed = 100;
constexpr const char* kStep = "unpacking the archive";
// Of folders within names: the standard's, and one that some programs write.
constexpr std::int64_t kLongestOfNothing = 2;  // bytes of a deflated stream that holds none
constexpr const char* kSeparators = "/\\";

// A name in a message.
std::string shown(const std::string& name) {
  constexpr std::size_t kLongest = 80;
  std::string text = name;
  if (name.size() > kLongest) {
    // Not in the middle of a UTF-8 sequence.
    std::size_t begin = name.size() - kLongest;
    while (begin < name.size() && (static_cast<unsigned char>(name[begin]) & 0xc0U) == 0x80U) ++begin;
    text = "..." + name.substr(begin);
  }
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
  return text;
}

// The end of the entry's own name, of letters, digits, points and hyphens; it keeps its suffix, by which
// volume files are known.
std::string harmless(std::string_view name) {
  constexpr std::size_t kLongest = 40;
  name.remove_prefix(std::min(name.find_last_of(kSeparators) + 1, name.size()));
  if (name.size() > kLongest) name.remove_prefix(name.size() - kLongest);
  std::string text(name);
  const auto is_harmless = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '-';
  };
  std::replace_if(
      text.begin(), text.end(), [&](char c) { return !is_harmless(c); }, '_');
  return text;
}

bool is_archive_name(std::string_view name) {
  constexpr std::string_view kSuffix = ".zip";
  if (name.size() < kSuffix.size()) return false;
  const std::string_view end = name.substr(name.size() - kSuffix.size());
  return std::equal(end.begin(), end.end(), kSuffix.begin(),
                    [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; });
}

// Takes entries out of an archive, one after the other.
class Unpacker {
 public:
  Unpacker(fs::path file, fs::path folder) : file_(std::move(file)), folder_(std::move(folder)) {}

  // Which entries there are, before anything is written.
  Status list(std::vector<SkippedFile>& left_out) {
    auto directory = ZipDirectory::read(file_, StudyArchive::kMostEntries);
    if (!directory) return pass_on(directory);
    directory_.emplace(std::move(*directory));
    for (const ZipRecord& record : directory_->records()) {
      const std::string& name = record.name;
      if (name.find_last_of(kSeparators) + 1 == name.size()) continue;  // a folder
      if (record.is_encrypted) {
        return refuse(fmt::format("is encrypted ({}); unpack it and open the folder", shown(name)));
      }
      if (is_archive_name(name)) {
        if (++archives_within_ <= kMostNamed) {
          left_out.push_back(
              {file_.string() + '/' + shown(name), "is an archive within the archive: unpack it first"});
        }
        continue;
      }
      if (record.bytes == 0 && record.packed <= kLongestOfNothing) {
        ++empty_;
        continue;
      }
      if (!record.is_readable()) {
        return refuse(fmt::format(
            "is compressed in a way that is not read ({}, method {}); unpack it and open the folder",
            shown(name), record.method));
      }
      // No more than the whole may be, so that the sum cannot overflow.
      constexpr std::int64_t kMost = std::int64_t{1} << 44;
      if (record.bytes > kMost) {
        return refuse(fmt::format("is damaged: {} is too large", shown(name)));
      }
      entries_.push_back(&record);
      total_ += record.bytes;
    }
    if (archives_within_ > kMostNamed) {
      left_out.push_back(
          {file_, fmt::format("holds {} more archives: unpack them first", archives_within_ - kMostNamed)});
    }
    if (empty_ > 0) left_out.push_back({file_, fmt::format("holds {} empty files", empty_)});
    return check_room();
  }

  Status unpack(const Progress& progress) {
    for (std::size_t entry = 0; entry < entries_.size(); ++entry) {
      if (progress.cancelled()) return cancelled_error();
      TIDEMARK_TRY(unpack_one(entry, progress));
    }
    return {};
  }

 private:
  [[nodiscard]] Status refuse(const std::string& why) const {
    return fail(ErrorKind::input, "{}: {}", file_.string(), why);
  }

  [[nodiscard]] Status check_room() const {
    std::error_code error;
    const auto packed = static_cast<std::int64_t>(fs::file_size(file_, error));
    if (total_ > kGiB && total_ / StudyArchive::kMostTimes > packed) {
      return refuse(fmt::format("would unpack to {} MB, {} times its size", total_ >> 20,
                                total_ / std::max<std::int64_t>(1, packed)));
    }
    const fs::space_info space = fs::space(folder_, error);
    if (error || total_ + kReserve <= static_cast<std::int64_t>(space.available)) return {};
    return fail(
        ErrorKind::write,
        "{}: unpacks to {} MB, for which {} has no room ({} MB are free); TMPDIR names another folder",
        file_.string(), total_ >> 20, folder_.parent_path().parent_path().string(), space.available >> 20);
  }

  // Entries of one folder lie in one folder: whether files belong together may depend on it.
  Result<fs::path> target_of(std::size_t entry) {
    const std::string& name = entries_[entry]->name;
    const std::string within = name.substr(0, name.find_last_of(kSeparators) + 1);
    const auto [known, is_new] =
        folders_.try_emplace(within, folder_ / fmt::format("{:04}", folders_.size() + 1));
    std::error_code error;
    if (is_new && !fs::create_directory(known->second, error)) {
      return fail(ErrorKind::write, "{}: cannot be made: {}", known->second.string(), error.message());
    }
    const auto number = entries_[entry] - directory_->records().data() + 1;
    return known->second / fmt::format("{:06}-{}", number, harmless(name));
  }

  Status unpack_one(std::size_t entry, const Progress& progress) {
    const auto target = target_of(entry);
    if (!target) return pass_on(target);
    const Status no_room = fail(ErrorKind::write, "{}: there is no room to unpack it", file_.string());
    std::ofstream out(*target, std::ios::binary);
    Status unpacked =
        directory_->unpack(*entries_[entry], [&](std::span<const std::uint8_t> piece) -> Status {
          if (progress.cancelled()) return cancelled_error();
          out.write(reinterpret_cast<const char*>(piece.data()), static_cast<std::streamsize>(piece.size()));
          if (!out) return no_room;
          done_ += static_cast<std::int64_t>(piece.size());
          progress(static_cast<double>(done_) / static_cast<double>(std::max<std::int64_t>(1, total_)),
                   kStep);
          return {};
        });
    if (!unpacked && unpacked.error().kind == ErrorKind::input) {
      return refuse(
          fmt::format("is damaged: {}: {}", shown(entries_[entry]->name), unpacked.error().message));
    }
    if (!unpacked) return unpacked;
    out.close();
    return out ? Status() : no_room;
  }

  fs::path file_;
  fs::path folder_;
  std::optional<ZipDirectory> directory_;
  std::vector<const ZipRecord*> entries_;  // that are unpacked
  std::int64_t archives_within_ = 0;
  std::int64_t empty_ = 0;
  std::int64_t total_ = 0;  // bytes of all entries
  std::int64_t done_ = 0;   // bytes written
  std::map<std::string, fs::path> folders_;
};

}  // namespace

bool is_zip_archive(const fs::path& file) {
  std::array<char, 4> start{};
  std::ifstream(file, std::ios::binary).read(start.data(), start.size());
  return std::memcmp(start.data(), "PK\x03\x04", 4) == 0 || std::memcmp(start.data(), "PK\x05\x06", 4) == 0;
}

StudyArchive::StudyArchive(fs::path file, PrivateFolder folder)
    : file_(std::move(file)), folder_(std::move(folder)) {}

Result<std::shared_ptr<const StudyArchive>> StudyArchive::unpack(const fs::path& file,
                                                                 const Progress& progress) {
  auto folder = PrivateFolder::create();
  if (!folder) return pass_on(folder);
  const std::shared_ptr<StudyArchive> archive(new StudyArchive(file, std::move(*folder)));
  Unpacker unpacker(file, archive->folder());
  TIDEMARK_TRY(unpacker.list(archive->left_out_));
  TIDEMARK_TRY(unpacker.unpack(progress));
  return archive;
}

std::string StudyArchive::name_archive_in(std::string message) const {
  const std::string inside = folder().string();
  for (auto at = message.find(inside); at != std::string::npos; at = message.find(inside, at)) {
    message.replace(at, inside.size(), file_.string());
  }
  return message;
}

}  // namespace tidemark::imaging
