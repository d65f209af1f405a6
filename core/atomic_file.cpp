#include "core/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

namespace tidemark {
namespace {

// A temporary file's name: this, six characters, a hyphen, and the target's name.
constexpr std::string_view kPrefix = ".tidemark-";
constexpr std::string_view kUnique = "XXXXXX";

std::string reason(int error) {
  return std::generic_category().message(error);
}

// Syncs a file or a folder; returns 0 or errno.
int sync_path(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return errno;
  const int error = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  return error;
}

std::filesystem::path folder_of(const std::filesystem::path& target) {
  return target.has_parent_path() ? target.parent_path() : std::filesystem::path(".");
}

}  // namespace

Result<AtomicFile> AtomicFile::create(const std::filesystem::path& target) {
  const std::filesystem::path folder = folder_of(target);
  std::error_code ignored;
  if (std::filesystem::is_directory(target, ignored)) {
    return fail(ErrorKind::write, "{}: cannot write: it is a folder", target.string());
  }
  // mkstemps makes the name unique; the target's own name stays at the end.
  const std::string suffix = "-" + target.filename().string();
  std::string pattern = (folder / (std::string(kPrefix) + std::string(kUnique) + suffix)).string();
  const int descriptor = ::mkstemps(pattern.data(), static_cast<int>(suffix.size()));
  if (descriptor < 0) {
    return fail(ErrorKind::write, "{}: cannot write: {}", target.string(), reason(errno));
  }
  // mkstemps creates files for their owner alone; a result gets the permissions of any new file.
  const mode_t mask = ::umask(0);
  ::umask(mask);
  ::fchmod(descriptor, 0666 & ~mask);
  ::close(descriptor);

  AtomicFile file;
  file.target_ = target;
  file.temporary_ = pattern;
  return file;
}

std::string AtomicFile::target_of(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  constexpr std::size_t kHyphen = kPrefix.size() + kUnique.size();
  return name.starts_with(kPrefix) && name.size() > kHyphen && name[kHyphen] == '-' ? name.substr(kHyphen + 1)
                                                                                    : std::string();
}

AtomicFile::~AtomicFile() {
  std::error_code ignored;
  if (!temporary_.empty()) std::filesystem::remove(temporary_, ignored);
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : target_(std::move(other.target_)), temporary_(std::exchange(other.temporary_, {})) {}

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
  std::swap(target_, other.target_);
  std::swap(temporary_, other.temporary_);
  return *this;
}

Status AtomicFile::commit() {
  if (const int error = sync_path(temporary_); error != 0) {
    return fail(ErrorKind::write, "{}: cannot write: {}", target_.string(), reason(error));
  }
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) {
    return fail(ErrorKind::write, "{}: cannot write: {}", target_.string(), reason(errno));
  }
  temporary_.clear();
  sync_path(folder_of(target_));  // makes the new name durable; the contents already are
  return {};
}

Status write_file(const std::filesystem::path& target, std::string_view bytes) {
  auto file = AtomicFile::create(target);
  if (!file) return pass_on(file);
  const int descriptor = ::open(file->temporary_path().c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
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
