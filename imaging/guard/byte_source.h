// Bytes that are read from front to back, without ever holding more than a small window of them.
#pragma once

#include <zlib.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>

#include "core/result.h"

namespace tidemark::imaging {

class ByteSource {
 public:
  virtual ~ByteSource() = default;
  [[nodiscard]] virtual std::int64_t size() const = 0;
  // The bytes from `offset` on, as many as `room` holds; fewer only where the source ends or cannot be read.
  virtual std::size_t read(std::int64_t offset, std::span<std::uint8_t> room) = 0;
};

class MemoryBytes : public ByteSource {
 public:
  explicit MemoryBytes(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  [[nodiscard]] std::int64_t size() const override { return static_cast<std::int64_t>(bytes_.size()); }
  std::size_t read(std::int64_t offset, std::span<std::uint8_t> room) override;

 private:
  std::span<const std::uint8_t> bytes_;
};

// Of a file, through its descriptor: a mapping would end the program when the file shrinks meanwhile.
class FileBytes : public ByteSource {
 public:
  // Fails (ErrorKind::input) naming the file.
  static Result<FileBytes> open(const std::filesystem::path& file);
  ~FileBytes() override;
  FileBytes(FileBytes&& other) noexcept;
  FileBytes& operator=(FileBytes&&) = delete;

  [[nodiscard]] std::int64_t size() const override { return size_; }
  std::size_t read(std::int64_t offset, std::span<std::uint8_t> room) override;

 private:
  FileBytes(int descriptor, std::int64_t size) : descriptor_(descriptor), size_(size) {}
  int descriptor_;
  std::int64_t size_;
};

// A part of another source.
class ByteRange : public ByteSource {
 public:
  // It lies within `whole`, which must outlive it.
  ByteRange(ByteSource& whole, std::int64_t begin, std::int64_t size)
      : whole_(whole), begin_(begin), size_(size) {}
  [[nodiscard]] std::int64_t size() const override { return size_; }
  std::size_t read(std::int64_t offset, std::span<std::uint8_t> room) override;

 private:
  ByteSource& whole_;
  std::int64_t begin_;
  std::int64_t size_;
};

// The inflated bytes of the raw deflate stream that begins at `begin` of another source. They can be read
// forward only; zlib keeps some 40 KB for it.
class InflatedBytes : public ByteSource {
 public:
  // `size` is from measure(), or a claim that is not trusted; `packed` must outlive it.
  InflatedBytes(ByteSource& packed, std::int64_t begin, std::int64_t size);
  ~InflatedBytes() override;
  InflatedBytes(const InflatedBytes&) = delete;
  InflatedBytes& operator=(const InflatedBytes&) = delete;

  // How many bytes the whole stream inflates to. Keeps none of them and stops beyond `limit`. Fails
  // (ErrorKind::input), without naming a file, when the stream is damaged, ends early or goes beyond.
  static Result<std::int64_t> measure(ByteSource& packed, std::int64_t begin, std::int64_t limit);

  [[nodiscard]] std::int64_t size() const override { return size_; }
  std::size_t read(std::int64_t offset, std::span<std::uint8_t> room) override;
  // Once all was read: fails, without naming a file, when the stream is damaged or ends early.
  [[nodiscard]] Status ended() const;

 private:
  std::size_t inflate_some(std::span<std::uint8_t> room);

  ByteSource& packed_;
  std::int64_t packed_at_;
  std::int64_t size_;
  std::int64_t at_ = 0;  // of the inflated bytes
  int state_ = Z_OK;
  z_stream stream_{};
  std::array<std::uint8_t, 4096> packed_window_;
};

// A window over a source that moves forward.
class ByteReader {
 public:
  static constexpr std::size_t kMost = 64;

  explicit ByteReader(ByteSource& source) : source_(source) {}
  [[nodiscard]] std::int64_t size() const { return source_.size(); }
  // `count` (at most kMost) bytes at `offset`, valid until the next call; null when the source has not got
  // them.
  const std::uint8_t* at(std::int64_t offset, std::size_t count);

 private:
  ByteSource& source_;
  std::int64_t begin_ = 0;
  std::size_t held_ = 0;
  std::array<std::uint8_t, 4096> window_;
};

}  // namespace tidemark::imaging
