#include "imaging/guard/byte_source.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

namespace tidemark::imaging {

std::size_t MemoryBytes::read(std::int64_t offset, std::span<std::uint8_t> room) {
  if (offset < 0 || offset >= size()) return 0;
  const auto part = bytes_.subspan(static_cast<std::size_t>(offset));
  const std::size_t count = std::min(part.size(), room.size());
  std::memcpy(room.data(), part.data(), count);
  return count;
}

Result<FileBytes> FileBytes::open(const std::filesystem::path& file) {
  // A plain open would wait at a pipe without a writer.
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  struct stat status {};
  if (descriptor < 0 || ::fstat(descriptor, &status) != 0) {
    const std::string why = std::generic_category().message(errno);
    if (descriptor >= 0) ::close(descriptor);
    return fail(ErrorKind::input, "{}: cannot be read: {}", file.string(), why);
  }
  FileBytes bytes(descriptor, status.st_size);
  if (!S_ISREG(status.st_mode)) return fail(ErrorKind::input, "{}: is not a file", file.string());
  return bytes;
}

FileBytes::~FileBytes() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

FileBytes::FileBytes(FileBytes&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), size_(other.size_) {}

std::size_t FileBytes::read(std::int64_t offset, std::span<std::uint8_t> room) {
  std::size_t done = 0;
  while (done < room.size()) {
    const auto got = ::pread(descriptor_, room.data() + done, room.size() - done,
                             static_cast<off_t>(offset) + static_cast<off_t>(done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

std::size_t ByteRange::read(std::int64_t offset, std::span<std::uint8_t> room) {
  if (offset >= size_) return 0;
  const auto most = static_cast<std::uint64_t>(size_ - offset);
  return whole_.read(begin_ + offset, room.first(std::min<std::uint64_t>(room.size(), most)));
}

InflatedBytes::InflatedBytes(ByteSource& packed, std::int64_t begin, std::int64_t size)
    : packed_(packed), packed_at_(begin), size_(size) {
  constexpr int kRawDeflate = -MAX_WBITS;
  if (inflateInit2(&stream_, kRawDeflate) != Z_OK) state_ = Z_MEM_ERROR;
}

InflatedBytes::~InflatedBytes() {
  inflateEnd(&stream_);
}

std::size_t InflatedBytes::inflate_some(std::span<std::uint8_t> room) {
  stream_.next_out = room.data();
  stream_.avail_out = static_cast<uInt>(room.size());
  while (stream_.avail_out > 0 && state_ == Z_OK) {
    if (stream_.avail_in == 0) {
      const std::size_t got = packed_.read(packed_at_, packed_window_);
      packed_at_ += static_cast<std::int64_t>(got);
      stream_.next_in = packed_window_.data();
      stream_.avail_in = static_cast<uInt>(got);
    }
    // Also when all input is taken: some output may still be pending.
    const int state = inflate(&stream_, Z_NO_FLUSH);
    if (state == Z_BUF_ERROR) break;  // nothing has
    state_ = state;
  }
  return room.size() - stream_.avail_out;
}

std::size_t InflatedBytes::read(std::int64_t offset, std::span<std::uint8_t> room) {
  std::array<std::uint8_t, 4096> passed;
  while (at_ < offset) {
    const auto step = std::min<std::uint64_t>(
        passed.size(), static_cast<std::uint64_t>(offset) - static_cast<std::uint64_t>(at_));
    const std::size_t got = inflate_some(std::span(passed).first(static_cast<std::size_t>(step)));
    if (got == 0) return 0;
    at_ += static_cast<std::int64_t>(got);
  }
  const std::size_t got = inflate_some(room);
  at_ += static_cast<std::int64_t>(got);
  return got;
}

Status InflatedBytes::ended() const {
  if (state_ == Z_STREAM_END) return {};
  if (state_ == Z_MEM_ERROR) return fail(ErrorKind::capability, "there is not enough memory");
  return fail(ErrorKind::input, "{}",
              state_ == Z_OK ? "ends within its deflate stream" : "is not a deflate stream");
}

Result<std::int64_t> InflatedBytes::measure(ByteSource& packed, std::int64_t begin, std::int64_t limit) {
  InflatedBytes bytes(packed, begin, 0);
  std::array<std::uint8_t, 4096> passed;
  while (const std::size_t got = bytes.inflate_some(passed)) {
    bytes.at_ += static_cast<std::int64_t>(got);
    if (bytes.at_ > limit) {
      return fail(ErrorKind::input, "inflates to more than {} bytes", limit);
    }
  }
  TIDEMARK_TRY(bytes.ended());
  return bytes.at_;
}

const std::uint8_t* ByteReader::at(std::int64_t offset, std::size_t count) {
  const bool inside = offset >= begin_ &&
                      offset + static_cast<std::int64_t>(count) <= begin_ + static_cast<std::int64_t>(held_);
  if (!inside) {
    // Bytes that are held and still wanted stay: an inflated source cannot be read backwards.
    const std::int64_t end = begin_ + static_cast<std::int64_t>(held_);
    const std::size_t kept = offset >= begin_ && offset < end ? static_cast<std::size_t>(end - offset) : 0;
    std::memmove(window_.data(), window_.data() + (held_ - kept), kept);
    begin_ = offset;
    held_ = kept + source_.read(offset + static_cast<std::int64_t>(kept), std::span(window_).subspan(kept));
    if (held_ < count) return nullptr;
  }
  return window_.data() + (offset - begin_);
}

}  // namespace tidemark::imaging
