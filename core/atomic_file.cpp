#include "core/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstring>
#include <random>
#include <system_error>
#include <utility>
#include <vector>

namespace tidemark {
namespace {

namespace fs = std::filesystem;

// A temporary name: this, six characters, a hyphen, and the target's name.
constexpr std::string_view kPrefix = ".tidemark-";
constexpr std::size_t kUnique = 6;
constexpr std::string_view kOlder = "-older";  // behind it: the folder that one of that name replaces

std::string reason(int error) {
  return std::generic_category().message(error);
}

std::atomic<int> sync_later{0};

// Syncs a file or a folder; returns 0 or errno.
int sync_path(const fs::path& path) {
  if (sync_later > 0) return 0;
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return errno;
  const int error = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  return error;
}

fs::path folder_of(const fs::path& target) {
  return target.has_parent_path() ? target.parent_path() : fs::path(".");
}

// Of the target's name what there is room for in a temporary one: its end, by whose suffix libraries go.
std::string name_in_temporary(const fs::path& target) {
  constexpr std::size_t kLongest = NAME_MAX - (kPrefix.size() + kUnique + 1) - kOlder.size();
  const std::string name = target.filename().string();
  std::size_t begin = name.size() - std::min(name.size(), kLongest);
  while (begin < name.size() && (static_cast<unsigned char>(name[begin]) & 0xc0) == 0x80) ++begin;
  return name.substr(begin);
}

// What a link leads to, so that it stays one.
fs::path place_of(const fs::path& target) {
  std::error_code error;
  if (!fs::is_symlink(target, error)) return target;
  fs::path place = fs::canonical(target, error);
  return error ? target : place;
}

// A folder that a new one can replace. A user who works in the current one, or has a disk mounted
// there, would be left with the old one.
Status require_replaceable(const fs::path& folder, const fs::path& target) {
  const auto refuse = [&](const char* why) {
    return fail(ErrorKind::write, "{}: cannot write: {}", target.string(), why);
  };
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) return refuse("it is a file");
  if (fs::equivalent(folder, fs::current_path(ignored), ignored)) {
    return refuse("it is the current folder; name a new one in it");
  }
  struct statx state {};
  if (::statx(AT_FDCWD, folder.c_str(), 0, 0, &state) == 0 &&
      (state.stx_attributes & STATX_ATTR_MOUNT_ROOT) != 0) {
    return refuse("a disk is mounted there; name a new folder in it");
  }
  return {};
}

// Removes the folders that killed programs were filling for this target.
void sweep_beside(const fs::path& target) {
  std::error_code error;
  std::vector<fs::path> left;
  for (fs::directory_iterator entry(folder_of(target), error), end; !error && entry != end;
       entry.increment(error)) {
    const bool is_named_so = AtomicFile::target_of(entry->path()) == name_in_temporary(target);
    if (is_named_so && is_own_folder(entry->path())) left.push_back(entry->path());
  }
  for (const fs::path& folder : left) {
    if (const FileLock lock = FileLock::take(folder)) fs::remove_all(folder, error);
  }
}

// Makes something beside the target whose name nothing has yet: `make` takes the name and returns 0 or errno.
// Its files and folders get usual permissions, which the C library's own temporary files do not.
template <class Make>
Result<fs::path> make_beside(const fs::path& target, const Make& make) {
  constexpr int kAttempts = 100;
  thread_local std::random_device random;  // costs more to make than to ask
  int error = target.filename().native().size() > NAME_MAX ? ENAMETOOLONG : EEXIST;
  for (int attempt = 0; attempt < kAttempts && error == EEXIST; ++attempt) {
    const std::string name =
        fmt::format("{}{:0{}x}-{}", kPrefix, random() & 0xffffffU, kUnique, name_in_temporary(target));
    const fs::path made = folder_of(target) / name;
    error = make(made);
    if (error == 0) return made;
  }
  return fail(ErrorKind::write, "{}: cannot write: {}", target.string(), reason(error));
}

// Makes a folder of that name and takes its lock, where the file system knows locks; returns 0 or errno.
int make_locked_folder(const fs::path& name, FileLock& lock) {
  if (::mkdir(name.c_str(), 0777) != 0) return errno;
  lock = FileLock::take(name);
  // Before it was locked, it was as one that is left: somebody's sweep may have it, or have had it.
  const bool is_swept = (!lock && FileLock::is_taken(name)) || !is_own_folder(name);
  return is_swept ? EEXIST : 0;
}

}  // namespace

Result<AtomicFile> AtomicFile::create(const fs::path& target) {
  std::error_code ignored;
  if (fs::is_directory(target, ignored)) {
    return fail(ErrorKind::write, "{}: cannot write: it is a folder", target.string());
  }
  const fs::path place = place_of(target);
  auto made = make_beside(place, [](const fs::path& name) {
    const int descriptor = ::open(name.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (descriptor < 0) return errno;
    ::close(descriptor);
    return 0;
  });
  if (!made) return pass_on(made);
  AtomicFile file;
  file.target_ = place;
  file.temporary_ = std::move(*made);
  file.unfinished_ = Unfinished(file.temporary_);
  if (const fs::file_status older = fs::status(place, ignored); fs::is_regular_file(older)) {
    fs::permissions(file.temporary_, older.permissions() | fs::perms::owner_read | fs::perms::owner_write,
                    ignored);
  }
  return file;
}

std::string AtomicFile::target_of(const fs::path& file) {
  const std::string name = file.filename().string();
  constexpr std::size_t kHyphen = kPrefix.size() + kUnique;
  return name.starts_with(kPrefix) && name.size() > kHyphen && name[kHyphen] == '-' ? name.substr(kHyphen + 1)
                                                                                    : std::string();
}

AtomicFile::~AtomicFile() {
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove(temporary_, ignored);
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, {})),
      unfinished_(std::move(other.unfinished_)) {}

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
  std::swap(target_, other.target_);
  std::swap(temporary_, other.temporary_);
  std::swap(unfinished_, other.unfinished_);
  return *this;
}

Status AtomicFile::sync() const {
  const int error = sync_path(temporary_);
  if (error == 0) return {};
  return fail(ErrorKind::write, "{}: cannot write: {}", target_.string(), reason(error));
}

Status AtomicFile::take_name() {
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) {
    return fail(ErrorKind::write, "{}: cannot write: {}", target_.string(), reason(errno));
  }
  temporary_.clear();
  return {};
}

Status AtomicFile::commit() {
  return commit_all(std::span(this, 1));
}

Status AtomicFile::commit_all(std::span<AtomicFile> files, const Progress& progress) {
  for (const AtomicFile& file : files) {
    if (progress.cancelled()) return cancelled_error();
    TIDEMARK_TRY(file.sync());
  }
  if (progress.cancelled()) return cancelled_error();
  for (AtomicFile& file : files) TIDEMARK_TRY(file.take_name());
  // Makes the new names durable; the contents already are.
  for (const AtomicFile& file : files) sync_path(folder_of(file.target_));
  return {};
}

Result<AtomicFolder> AtomicFolder::create(const fs::path& target) {
  std::error_code error;
  // A link stays one: what it leads to is exchanged. "series/" is "series".
  const fs::path named = target.has_filename() ? target : target.parent_path();
  if (named.has_parent_path()) fs::create_directories(named.parent_path(), error);
  if (error) return fail(ErrorKind::write, "{}: cannot be made: {}", target.string(), error.message());
  const fs::path place = fs::exists(named, error) ? fs::canonical(named, error) : named;
  const bool has_older = fs::exists(place, error);
  if (has_older) {
    TIDEMARK_TRY(require_replaceable(place, target));
  }
  sweep_beside(place);
  FileLock lock;
  auto made = make_beside(place, [&](const fs::path& name) { return make_locked_folder(name, lock); });
  if (!made) return pass_on(made);
  AtomicFolder folder;
  folder.target_ = place;
  folder.temporary_ = std::move(*made);
  folder.unfinished_ = Unfinished(folder.temporary_);
  folder.lock_ = std::move(lock);
  if (has_older) {
    const fs::perms older = fs::status(place, error).permissions();
    fs::permissions(folder.temporary_, older | fs::perms::owner_all, error);
  }
  return folder;
}

AtomicFolder::~AtomicFolder() {
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove_all(temporary_, ignored);
}

AtomicFolder::AtomicFolder(AtomicFolder&& other) noexcept
    : target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, {})),
      unfinished_(std::move(other.unfinished_)),
      lock_(std::move(other.lock_)) {}

Status AtomicFolder::commit() {
  int error = sync_path(temporary_);
  if (error == 0 && ::rename(temporary_.c_str(), target_.c_str()) == 0) {
    temporary_.clear();
  } else if (error == 0) {
    // An older one with something in it is exchanged, and then removed by the destructor.
    error = errno == ENOTEMPTY || errno == EEXIST ? exchange() : errno;
  }
  if (error != 0) {
    return fail(ErrorKind::write, "{}: cannot write: {}", target_.string(), reason(error));
  }
  sync_path(folder_of(target_));
  return {};
}

int AtomicFolder::exchange() {
  if (::renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) == 0) return 0;
  if (errno != EINVAL && errno != ENOSYS) return errno;
  // Some network file systems cannot. For a moment there is then neither, but never a mixture.
  const fs::path older = temporary_.string() + std::string(kOlder);
  if (::rename(target_.c_str(), older.c_str()) != 0) return errno;
  if (::rename(temporary_.c_str(), target_.c_str()) == 0) {
    temporary_ = older;
    return 0;
  }
  const int error = errno;
  ::rename(older.c_str(), target_.c_str());
  return error;
}

SyncLater::SyncLater() {
  ++sync_later;
}

SyncLater::~SyncLater() {
  --sync_later;
}

Status sync_file_system(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_CLOEXEC);
  const int error = descriptor >= 0 && ::syncfs(descriptor) == 0 ? 0 : errno;
  if (descriptor >= 0) ::close(descriptor);
  if (error == 0) return {};
  return fail(ErrorKind::write, "{}: cannot write: {}", folder.string(), reason(error));
}

Status sync_to_disk(const fs::path& path) {
  const int error = sync_path(path);
  if (error == 0) return {};
  return fail(ErrorKind::write, "{}: cannot write: {}", path.string(), reason(error));
}

Status write_file(const fs::path& target, std::string_view bytes) {
  auto file = AtomicFile::create(target);
  if (!file) return pass_on(file);
  // It is empty. ext4 sends a file to the disk at once, as it is closed, where it was made so by O_TRUNC.
  const int descriptor = ::open(file->temporary_path().c_str(), O_WRONLY | O_CLOEXEC);
  int error = descriptor < 0 ? errno : 0;
  while (error == 0 && !bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(written));
    } else if (written < 0 && errno != EINTR) {
      error = errno;
    }
  }
  if (descriptor >= 0 && ::close(descriptor) != 0 && error == 0) error = errno;
  if (error != 0) return fail(ErrorKind::write, "{}: cannot write: {}", target.string(), reason(error));
  return file->commit();
}

}  // namespace tidemark
