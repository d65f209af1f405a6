#include "core/text_file.h"

#include <fstream>

namespace tidemark {

Result<std::string> read_text_file(const std::filesystem::path& file, std::size_t most) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (error) return fail(ErrorKind::input, "{}: cannot be read: {}", file.string(), error.message());
  if (size > most) {
    return fail(ErrorKind::input, "{}: {} bytes, more than {} are not read", file.string(), size, most);
  }
  std::ifstream stream(file, std::ios::binary);
  std::string text(size, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(size));
  if (stream.gcount() != static_cast<std::streamsize>(size)) {
    return fail(ErrorKind::input, "{}: cannot be read", file.string());
  }
  return text;
}

}  // namespace tidemark
