// The entries of a zip archive (PKWARE's APPNOTE), by its directory at the end. libzip reads a directory for
// every end of one that an archive claims to have, keeps all its names before it can be asked how many there
// are, and takes time with the square of their number when they are made for it; nothing here does.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/result.h"
#include "imaging/guard/byte_source.h"

namespace tidemark::imaging {

struct ZipRecord {
  static constexpr std::uint16_t kStored = 0;
  static constexpr std::uint16_t kDeflated = 8;

  std::string name;                // as it is in the file
  std::int64_t begin = 0;          // of the entry, which repeats its name before its bytes
  std::int64_t end = 0;            // where the next entry begins, or the directory
  std::int64_t packed = 0;         // bytes in the archive
  std::int64_t bytes = 0;          // that they are unpacked to
  std::uint32_t checksum = 0;      // CRC-32 of those
  std::uint16_t method = kStored;  // of compression
  bool is_encrypted = false;
  [[nodiscard]] bool is_readable() const { return method == kStored || method == kDeflated; }
};

class ZipDirectory {
 public:
  // Fails (ErrorKind::input), naming the file, when it is damaged, has more entries, or has entries that
  // overlap: each one costs bytes of its own. Takes memory for the entries and for 64 MiB of directory at
  // most.
  static Result<ZipDirectory> read(const std::filesystem::path& file, std::int64_t most_entries);
  // The same, without naming the file.
  static Result<ZipDirectory> read(FileBytes file, std::int64_t most_entries);

  // Their sizes are not negative, and their packed bytes no more than the file's.
  [[nodiscard]] const std::vector<ZipRecord>& records() const { return records_; }

  // Calls take(piece) for piece after piece of the entry's bytes until it fails. Fails (ErrorKind::input),
  // without naming the file, when the entry is damaged: piece for piece no more bytes come than it says.
  using Take = std::function<Status(std::span<const std::uint8_t> piece)>;
  [[nodiscard]] Status unpack(const ZipRecord& record, const Take& take);

 private:
  explicit ZipDirectory(FileBytes file) : file_(std::move(file)) {}
  Status read_records(std::int64_t most_entries);

  FileBytes file_;
  std::vector<ZipRecord> records_;
};

}  // namespace tidemark::imaging
