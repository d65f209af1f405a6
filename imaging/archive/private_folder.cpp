#include "imaging/archive/private_folder.h"

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace tidemark::imaging {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "tidemark-study-";
constexpr const char* kLock = "lock";
// How long a folder may be without its lock file: it is being made.
constexpr std::chrono::minutes kYouth(10);

bool is_being_made(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(fs::symlink_status(folder / kLock, error))) return false;
  const auto changed = fs::last_write_time(folder, error);
  return !error && fs::file_time_type::clock::now() - changed < kYouth;
}

}  // namespace

PrivateFolder::PrivateFolder(fs::path folder, FileLock lock)
    : folder_(std::move(folder)), unfinished_(folder_), lock_(std::move(lock)) {}

PrivateFolder::PrivateFolder(PrivateFolder&& other) noexcept
    : folder_(std::exchange(other.folder_, {})),
      unfinished_(std::move(other.unfinished_)),
      lock_(std::move(other.lock_)) {}

PrivateFolder::~PrivateFolder() {
  std::error_code ignored;
  if (!folder_.empty()) fs::remove_all(folder_, ignored);
}

Result<PrivateFolder> PrivateFolder::create() {
  std::error_code error;
  const fs::path parent = fs::temp_directory_path(error);
  if (error) return fail(ErrorKind::write, "there is no folder for temporary files: {}", error.message());
  sweep_private_folders(parent);
  std::string pattern;
  // Before it is locked, it is as one that is left: somebody's sweep may have it.
  constexpr int kAttempts = 10;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    pattern = (parent / (std::string(kPrefix) + "XXXXXX")).string();
    if (::mkdtemp(pattern.data()) == nullptr) {
      return fail(ErrorKind::write, "{}: cannot make a folder: {}", parent.string(),
                  std::generic_category().message(errno));
    }
    PrivateFolder folder(pattern, FileLock::take(fs::path(pattern) / kLock, FileLock::Missing::make));
    if (folder.lock_ && fs::create_directory(folder.path(), error)) return folder;
  }
  return fail(ErrorKind::write, "{}: cannot be written to", pattern);
}

void sweep_private_folders(const fs::path& parent) {
  std::error_code error;
  std::vector<fs::path> left;
  for (fs::directory_iterator entry(parent, error), end; !error && entry != end; entry.increment(error)) {
    const bool is_named_so = entry->path().filename().string().starts_with(kPrefix);
    if (is_named_so && is_own_folder(entry->path())) left.push_back(entry->path());
  }
  for (const fs::path& folder : left) {
    if (is_being_made(folder)) continue;
    const FileLock lock = FileLock::take(folder / kLock, FileLock::Missing::make);
    if (lock) fs::remove_all(folder, error);
  }
}

}  // namespace tidemark::imaging
