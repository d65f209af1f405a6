#include "imaging/guard/file_stamp.h"

#include <sys/stat.h>

#include <cerrno>
#include <cstring>

namespace tidemark::imaging {

Result<FileStamp> FileStamp::of(const std::filesystem::path& file) {
  struct stat found {};
  if (::stat(file.c_str(), &found) != 0) {
    return fail(ErrorKind::input, "{}: {}", file.string(), std::strerror(errno));
  }
  constexpr std::int64_t kNanoseconds = 1'000'000'000;
  return FileStamp{found.st_dev, found.st_ino, found.st_size,
                   found.st_mtim.tv_sec * kNanoseconds + found.st_mtim.tv_nsec};
}

Status require_unchanged(const std::filesystem::path& file, const FileStamp& before) {
  const auto now = FileStamp::of(file);
  if (now && *now == before) return {};
  return fail(ErrorKind::input, "{}: has changed while it was read", file.string());
}

}  // namespace tidemark::imaging
