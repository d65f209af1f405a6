// A file's identity and age, by which one that is replaced or written to while it is read is noticed.
#pragma once

#include <cstdint>
#include <filesystem>

#include "core/result.h"

namespace tidemark::imaging {

struct FileStamp {
  std::uint64_t device = 0;
  std::uint64_t number = 0;  // of its inode
  std::int64_t size = 0;     // bytes
  std::int64_t changed_ns = 0;

  // Fails (ErrorKind::input) naming the file.
  static Result<FileStamp> of(const std::filesystem::path& file);
  bool operator==(const FileStamp&) const = default;
};

// Fails (ErrorKind::input) naming the file when it is not the one that had that stamp.
Status require_unchanged(const std::filesystem::path& file, const FileStamp& before);

}  // namespace tidemark::imaging
