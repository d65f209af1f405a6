// Zip archives whose entries are a short list of known names.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "imaging/guard/zip_directory.h"

namespace tidemark::document {

class ZipReader {
 public:
  // Fails (ErrorKind::input) on what is no zip archive, or holds an entry that is not in `names`, or one
  // twice.
  static Result<ZipReader> open(const std::filesystem::path& file, std::span<const std::string_view> names);

  [[nodiscard]] bool has(std::string_view name) const;
  // The entry's bytes as its header states them.
  [[nodiscard]] std::size_t size(std::string_view name) const;
  [[nodiscard]] std::size_t packed_size(std::string_view name) const;  // within the archive
  // The whole entry, which must have exactly `bytes` bytes. No memory is taken for a size that so many
  // compressed bytes cannot hold.
  Result<std::vector<std::byte>> read(std::string_view name, std::size_t bytes);

 private:
  std::string file_;
  std::unique_ptr<imaging::ZipDirectory> directory_;
  std::map<std::string, const imaging::ZipRecord*, std::less<>> entries_;
};

// Writes an archive. The bytes must live until it has returned. Fails (ErrorKind::write) without naming the
// file.
struct ZipEntry {
  std::string_view name;
  std::span<const std::byte> bytes;
};
Status write_zip(const std::filesystem::path& file, std::span<const ZipEntry> entries);

}  // namespace tidemark::document
