// Results appear whole or not at all.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/result.h"

namespace tidemark {

// A file that is written beside its target and takes the target's name only when it is complete. Whoever
// writes uses temporary_path(); commit() syncs it to disk and renames it. Without a commit, the destructor
// removes the temporary file and the target is left as it was.
class AtomicFile {
 public:
  // Fails (ErrorKind::write) when the target's folder does not exist or cannot be written to.
  static Result<AtomicFile> create(const std::filesystem::path& target);
  ~AtomicFile();
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&& other) noexcept;

  // Ends with the target's whole file name, so that libraries that go by the suffix do the right thing.
  [[nodiscard]] const std::filesystem::path& temporary_path() const { return temporary_; }

  [[nodiscard]] Status commit();

  // The name of the target of which `file` is the temporary file; empty when it is none. A program that is
  // killed leaves it behind.
  [[nodiscard]] static std::string target_of(const std::filesystem::path& file);

 private:
  AtomicFile() = default;
  std::filesystem::path target_;
  std::filesystem::path temporary_;  // empty when committed or moved from
};

// Writes `bytes` as the whole of the file.
[[nodiscard]] Status write_file(const std::filesystem::path& target, std::string_view bytes);

}  // namespace tidemark
