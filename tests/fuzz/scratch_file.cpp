#include "tests/fuzz/scratch_file.h"

#include <stdlib.h>

#include <cstdlib>
#include <fstream>

namespace tidemark::fuzz {

ScratchFile::ScratchFile() {
  std::string pattern = (std::filesystem::temp_directory_path() / "tidemark-fuzz-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) std::abort();
  folder_ = pattern;
}

ScratchFile::~ScratchFile() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

std::filesystem::path ScratchFile::write(const char* name, const std::uint8_t* bytes, std::size_t count) {
  const auto file = folder_ / name;
  if (file.parent_path() != folder_) std::filesystem::create_directories(file.parent_path());
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  stream.write(reinterpret_cast<const char*>(bytes), static_cast<std::streamsize>(count));
  if (!stream.flush()) std::abort();
  return file;
}

}  // namespace tidemark::fuzz
