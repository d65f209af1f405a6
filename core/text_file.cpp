#include "core/text_file.h"

#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

namespace tidemark {

Result<std::string> read_text_file(const std::filesystem::path& file, std::size_t most) {
  const auto unreadable = [&](const std::error_code& error) {
    return fail(ErrorKind::input, "{}: cannot be read: {}", file.string(), error.message());
  };
  // What is no file of bytes is not opened: a pipe would wait.
  std::error_code error;
  static_cast<void>(std::filesystem::file_size(file, error));
  if (error) return unreadable(error);
  // The size is that of what was opened: another file may take its name at any time.
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> opened(std::fopen(file.c_str(), "rbe"), &std::fclose);
  struct stat status {};
  if (opened == nullptr || ::fstat(::fileno(opened.get()), &status) != 0)
    return unreadable({errno, std::generic_category()});
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size > most) {
    return fail(ErrorKind::input, "{}: {} bytes, more than {} are not read", file.string(), size, most);
  }
  std::string text(size, '\0');
  if (std::fread(text.data(), 1, size, opened.get()) != size) {
    return fail(ErrorKind::input, "{}: cannot be read", file.string());
  }
  return text;
}

}  // namespace tidemark
