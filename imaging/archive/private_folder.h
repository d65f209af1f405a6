// A folder for what is needed only while the program runs.
#pragma once

#include <filesystem>

#include "core/file_lock.h"
#include "core/result.h"
#include "core/unfinished.h"

namespace tidemark::imaging {

// Made where the system keeps temporary files, for its owner alone, and removed with the object. While it is
// there it is locked: what a program leaves that was killed is found by its lock, which nobody holds.
class PrivateFolder {
 public:
  // Fails (ErrorKind::write) when the folder cannot be made. Sweeps what others left.
  static Result<PrivateFolder> create();
  ~PrivateFolder();
  PrivateFolder(PrivateFolder&& other) noexcept;
  PrivateFolder& operator=(PrivateFolder&&) = delete;

  // Empty at first.
  [[nodiscard]] std::filesystem::path path() const { return folder_ / "files"; }

 private:
  PrivateFolder(std::filesystem::path folder, FileLock lock);
  std::filesystem::path folder_;  // empty when moved from
  Unfinished unfinished_;
  FileLock lock_;
};

// Removes this user's private folders below `parent` that no running program holds.
void sweep_private_folders(const std::filesystem::path& parent);

}  // namespace tidemark::imaging
