#include "imaging/archive/study_archive.h"

#include <zip.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <map>
#include <string_view>
#include <system_error>
#include <utility>

namespace tidemark {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kGiB = std::int64_t{1} << 30;
// What is left free of the disk.
constexpr std::int64_t kReserve = std::int64_t{256} << 20;
constexpr const char* kStep = "unpacking the archive";

struct Entry {
  zip_uint64_t index = 0;
  std::string name;
  std::int64_t bytes = 0;
};

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
  name.remove_prefix(std::min(name.find_last_of("/\\") + 1, name.size()));
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

  Status open() {
    int code = 0;
    archive_.reset(zip_open(file_.c_str(), ZIP_RDONLY, &code));
    if (archive_) return {};
    zip_error_t error;
    zip_error_init_with_code(&error, code);
    const std::string why = zip_error_strerror(&error);
    zip_error_fini(&error);
    return refuse("cannot be unpacked: " + why);
  }

  // Which entries there are, before anything is written.
  Status list(std::vector<SkippedFile>& left_out) {
    const zip_int64_t count = zip_get_num_entries(archive_.get(), 0);
    if (count > StudyArchive::kMostEntries) {
      return refuse(fmt::format("has {} entries, more than {}", count, StudyArchive::kMostEntries));
    }
    for (zip_int64_t i = 0; i < count; ++i) {
      zip_stat_t stat;
      zip_stat_init(&stat);
      constexpr zip_uint64_t kNeeded = ZIP_STAT_NAME | ZIP_STAT_SIZE;
      const auto index = static_cast<zip_uint64_t>(i);
      if (zip_stat_index(archive_.get(), index, 0, &stat) != 0 || (stat.valid & kNeeded) != kNeeded) {
        return refuse(fmt::format("is damaged: entry {} cannot be listed", i));
      }
      const std::string name = stat.name;
      if (name.empty() || name.ends_with('/')) continue;  // a folder
      if ((stat.valid & ZIP_STAT_ENCRYPTION_METHOD) != 0 && stat.encryption_method != ZIP_EM_NONE) {
        return refuse(fmt::format("is encrypted ({}); unpack it and open the folder", shown(name)));
      }
      if (is_archive_name(name)) {
        left_out.push_back({file_ / shown(name), "is an archive within the archive: unpack it first"});
        continue;
      }
      // No more than the whole may be, so that the sum cannot overflow.
      constexpr zip_uint64_t kMost = std::uint64_t{1} << 44;
      if (stat.size > kMost) return refuse(fmt::format("is damaged: {} is too large", shown(name)));
      entries_.push_back({index, name, static_cast<std::int64_t>(stat.size)});
      total_ += entries_.back().bytes;
    }
    return check_room();
  }

  Status unpack(const Progress& progress) {
    std::int64_t done = 0;
    for (const Entry& entry : entries_) {
      if (Status written = unpack_one(entry, done, progress); !written) return written;
      done += entry.bytes;
    }
    return {};
  }

 private:
  struct Discard {
    void operator()(struct zip* archive) const { zip_discard(archive); }
  };

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
        ErrorKind::capability,
        "{}: unpacks to {} MB, for which {} has no room ({} MB are free); TMPDIR names another folder",
        file_.string(), total_ >> 20, folder_.parent_path().parent_path().string(), space.available >> 20);
  }

  // Entries of one folder lie in one folder: whether files belong together may depend on it.
  Result<fs::path> target_of(const Entry& entry) {
    const std::string within = entry.name.substr(0, entry.name.find_last_of('/') + 1);
    const auto [known, is_new] =
        folders_.try_emplace(within, folder_ / fmt::format("{:04}", folders_.size() + 1));
    std::error_code error;
    if (is_new && !fs::create_directory(known->second, error)) {
      return fail(ErrorKind::capability, "{}: cannot be made: {}", known->second.string(), error.message());
    }
    return known->second / fmt::format("{:06}-{}", entry.index + 1, harmless(entry.name));
  }

  Status unpack_one(const Entry& entry, std::int64_t before, const Progress& progress) {
    const auto damaged = [&](const std::string& why) {
      return refuse(fmt::format("is damaged: {}: {}", shown(entry.name), why));
    };
    const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> stream(
        zip_fopen_index(archive_.get(), entry.index, 0), zip_fclose);
    if (stream == nullptr) return damaged(zip_strerror(archive_.get()));
    const auto target = target_of(entry);
    if (!target) return tl::unexpected<Error>(target.error());
    std::ofstream out(*target, std::ios::binary);
    std::int64_t written = 0;
    while (true) {
      if (progress.cancelled()) return cancelled_error();
      const zip_int64_t got = zip_fread(stream.get(), window_.data(), window_.size());
      // Reading to the end is what compares the checksum.
      if (got < 0) return damaged(zip_file_strerror(stream.get()));
      if (got == 0) break;
      written += got;
      if (written > entry.bytes) return damaged("holds more than it says");
      out.write(window_.data(), got);
      if (!out) return fail(ErrorKind::capability, "{}: there is no room to unpack it", file_.string());
      progress(static_cast<double>(before + written) / static_cast<double>(std::max<std::int64_t>(1, total_)),
               kStep);
    }
    out.close();
    if (!out) return fail(ErrorKind::capability, "{}: there is no room to unpack it", file_.string());
    if (written != entry.bytes) return damaged("holds less than it says");
    return {};
  }

  fs::path file_;
  fs::path folder_;
  std::unique_ptr<struct zip, Discard> archive_;
  std::vector<Entry> entries_;
  std::int64_t total_ = 0;  // bytes of all entries
  std::map<std::string, fs::path> folders_;
  std::array<char, 1 << 16> window_{};
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
  const auto unpacker = std::make_unique<Unpacker>(file, archive->folder());  // its window is large
  if (Status opened = unpacker->open(); !opened) return pass_on(opened);
  if (Status listed = unpacker->list(archive->left_out_); !listed) return pass_on(listed);
  if (Status unpacked = unpacker->unpack(progress); !unpacked) return pass_on(unpacked);
  return archive;
}

std::string StudyArchive::told_outside(std::string message) const {
  const std::string inside = folder().string();
  for (auto at = message.find(inside); at != std::string::npos; at = message.find(inside, at)) {
    message.replace(at, inside.size(), file_.string());
  }
  return message;
}

}  // namespace tidemark
