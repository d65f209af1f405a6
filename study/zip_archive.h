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

struct zip;

namespace tidemark {

class ZipReader {
 public:
  // Fails (ErrorKind::input) on what is no zip archive, or holds an entry that is not in `names`, or one
  // twice.
  static Result<ZipReader> open(const std::filesystem::path& file, std::span<const std::string_view> names);

  [[nodiscard]] bool has(std::string_view name) const;
  // The entry's bytes as its header states them.
  [[nodiscard]] std::size_t size(std::string_view name) const;
  // The whole entry, which must have exactly `bytes` bytes. No memory is taken for a size that so many
  // compressed bytes cannot hold.
  Result<std::vector<std::byte>> read(std::string_view name, std::size_t bytes);

 private:
  struct Entry {
    std::size_t index = 0;
    std::size_t bytes = 0;
    std::size_t compressed = 0;
  };
  struct Discard {
    void operator()(struct zip* archive) const;
  };
  std::string file_;
  std::unique_ptr<struct zip, Discard> archive_;
  std::map<std::string, Entry, std::less<>> entries_;
};

// Writes an archive. The bytes must live until it has returned.
struct ZipEntry {
  std::string_view name;
  std::span<const std::byte> bytes;
};
Status write_zip(const std::filesystem::path& file, std::span<const ZipEntry> entries);

}  // namespace tidemark
