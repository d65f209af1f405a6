// Zip archives whose entries are a short list of known names.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
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
  // Calls take(piece) for piece after piece of the entry, which must have exactly `bytes` bytes, until it
  // fails. Fails (ErrorKind::input), naming the file, before the first one where so many compressed bytes
  // cannot hold them.
  Status unpack(std::string_view name, std::size_t bytes, const imaging::ZipDirectory::Take& take);
  // The whole entry, as so many numbers. Takes memory for what the archive can hold alone.
  template <class Number = std::byte>
  Result<std::vector<Number>> read(std::string_view name, std::size_t count);

 private:
  std::string file_;
  std::unique_ptr<imaging::ZipDirectory> directory_;
  std::map<std::string, const imaging::ZipRecord*, std::less<>> entries_;
};

template <class Number>
Result<std::vector<Number>> ZipReader::read(std::string_view name, std::size_t count) {
  std::vector<Number> numbers;
  std::size_t done = 0;
  TIDEMARK_TRY(unpack(name, count * sizeof(Number), [&](std::span<const std::uint8_t> piece) -> Status {
    numbers.resize(count);
    std::memcpy(reinterpret_cast<std::byte*>(numbers.data()) + done, piece.data(), piece.size());
    done += piece.size();
    return {};
  }));
  return numbers;
}

// An entry to be written. Its bytes lie in one piece, or are asked for piece by piece.
struct ZipEntry {
  // Piece after piece, from 0 on and perhaps from 0 again; an empty one is behind the last. It lives until
  // the next one is asked for, and asking does not fail.
  using Piece = std::function<std::span<const std::byte>(std::size_t number)>;

  // The bytes live until the archive is written.
  ZipEntry(std::string_view entry, std::span<const std::byte> all)
      : name(entry),
        bytes(all.size()),
        piece([all](std::size_t number) { return number == 0 ? all : std::span<const std::byte>(); }) {}
  ZipEntry(std::string_view entry, std::size_t length, Piece pieces)
      : name(entry), bytes(length), piece(std::move(pieces)) {}

  std::string_view name;
  std::size_t bytes;
  Piece piece;
};
// Writes an archive. Fails (ErrorKind::write) without naming the file.
Status write_zip(const std::filesystem::path& file, std::span<const ZipEntry> entries);

}  // namespace tidemark::document
