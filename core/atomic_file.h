// Files and folders that appear whole or not at all.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "core/file_lock.h"
#include "core/progress.h"
#include "core/result.h"
#include "core/unfinished.h"

namespace tidemark {

// A file that is written beside its target and takes the target's name only when it is complete. The caller
// writes to temporary_path(); commit() syncs it to disk and renames it. Without a commit, the destructor
// removes the temporary file and the target is left as it was. It has the permissions of an older file, and
// where the target is a link, it takes the place of what that leads to.
class AtomicFile {
 public:
  // Fails (ErrorKind::write) when the target's folder does not exist or cannot be written to.
  static Result<AtomicFile> create(const std::filesystem::path& target);
  ~AtomicFile();
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&& other) noexcept;

  // Ends with the target's file name, so that libraries that go by the suffix do the right thing. Of a long
  // one the beginning is left out.
  [[nodiscard]] const std::filesystem::path& temporary_path() const { return temporary_; }

  [[nodiscard]] Status commit();

  // Commits all of them or none: the first takes its name once all are on the disk. Until then it fails
  // (ErrorKind::cancelled) when told to stop.
  [[nodiscard]] static Status commit_all(std::span<AtomicFile> files, const Progress& progress = {});

  // The name of the target of which `file` is the temporary file or folder, or as much as it holds of a long
  // one; empty when it is none. A program that is killed leaves it behind.
  [[nodiscard]] static std::string target_of(const std::filesystem::path& file);

 private:
  AtomicFile() = default;
  [[nodiscard]] Status sync() const;
  [[nodiscard]] Status take_name();
  std::filesystem::path target_;
  std::filesystem::path temporary_;  // empty when committed or moved from
  Unfinished unfinished_;
};

// The same for a folder of files that belong together: it is filled under a temporary name beside its target,
// and takes the target's place and permissions when all are there. An older folder and everything in it goes
// away then. Until then it is locked. The folder of a killed program is known by its lock, which nobody
// holds, and is removed when the same target is next filled.
class AtomicFolder {
 public:
  // Makes the folders above the target where they are missing. Fails (ErrorKind::write) when they cannot be
  // made or written to, or the target is a file, or a folder that nothing else can take the place of: the
  // current one, or one where a disk is mounted.
  static Result<AtomicFolder> create(const std::filesystem::path& target);
  ~AtomicFolder();
  AtomicFolder(AtomicFolder&& other) noexcept;
  AtomicFolder& operator=(AtomicFolder&& other) = delete;

  [[nodiscard]] const std::filesystem::path& temporary_path() const { return temporary_; }

  // The files in it must be on the disk already, as write_file() and sync_to_disk() leave them.
  [[nodiscard]] Status commit();

 private:
  AtomicFolder() = default;
  int exchange();  // returns 0 or errno
  std::filesystem::path target_;
  std::filesystem::path temporary_;  // empty when it has been renamed or moved from
  Unfinished unfinished_;
  FileLock lock_;  // of the folder that was made
};

// While it lives, files and folders are committed without waiting for the disk, by every thread of this
// process. Whoever has made it syncs the file system before anybody may rely on them: many small files are
// then on the disk in the time of one.
class SyncLater {
 public:
  SyncLater();
  ~SyncLater();
  SyncLater(const SyncLater&) = delete;
  SyncLater& operator=(const SyncLater&) = delete;
};

// Waits until all that was written to the file system of a folder is on the disk. Fails (ErrorKind::write).
[[nodiscard]] Status sync_file_system(const std::filesystem::path& folder);

// Waits until what was written to a file, or the names in a folder, are on the disk. Fails
// (ErrorKind::write).
[[nodiscard]] Status sync_to_disk(const std::filesystem::path& path);

// Writes `bytes` as the whole of the file.
[[nodiscard]] Status write_file(const std::filesystem::path& target, std::string_view bytes);

}  // namespace tidemark
