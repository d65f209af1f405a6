#include "core/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <thread>
#include <utility>

namespace tidemark {
namespace {

constexpr int kOpened = O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK;

// A folder cannot be opened for writing; a file must be, for a network file system to lock it.
int open_to_lock(const std::filesystem::path& path, int flags) {
  const int descriptor = ::open(path.c_str(), O_RDWR | kOpened | flags, 0600);
  return descriptor < 0 && errno == EISDIR ? ::open(path.c_str(), O_RDONLY | O_DIRECTORY | kOpened)
                                           : descriptor;
}

}  // namespace

FileLock FileLock::take(const std::filesystem::path& path, Missing missing) {
  FileLock lock;
  lock.descriptor_ = open_to_lock(path, missing == Missing::make ? O_CREAT : 0);
  if (lock && ::flock(lock.descriptor_, LOCK_EX | LOCK_NB) != 0) lock = FileLock();
  return lock;
}

FileLock FileLock::wait(const std::filesystem::path& path, Missing missing, const std::stop_token& stop) {
  constexpr std::chrono::milliseconds kPause(50);
  FileLock lock;
  lock.descriptor_ = open_to_lock(path, missing == Missing::make ? O_CREAT : 0);
  while (lock && ::flock(lock.descriptor_, LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK || stop.stop_requested()) return {};
    std::this_thread::sleep_for(kPause);
  }
  return lock;
}

bool FileLock::is_taken(const std::filesystem::path& path) {
  FileLock lock;
  lock.descriptor_ = open_to_lock(path, 0);
  return lock && ::flock(lock.descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

// To close it is not enough: a process that was forked meanwhile has the descriptor, too.
FileLock::~FileLock() {
  if (!*this) return;
  ::flock(descriptor_, LOCK_UN);
  ::close(descriptor_);
}

FileLock::FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

FileLock& FileLock::operator=(FileLock&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

bool is_own_folder(const std::filesystem::path& path) {
  struct stat found {};
  return ::lstat(path.c_str(), &found) == 0 && S_ISDIR(found.st_mode) && found.st_uid == ::geteuid();
}

}  // namespace tidemark
