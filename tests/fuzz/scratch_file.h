// A file that holds each input of a fuzz target, for readers of files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace tidemark::fuzz {

// In a folder of its own below the folder for temporary files ($TMPDIR, best in memory), which goes away with
// the process.
class ScratchFile {
 public:
  ScratchFile();
  ~ScratchFile();
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  // The file of that name, with these bytes. Files of other names stay as they are.
  std::filesystem::path write(const char* name, const std::uint8_t* bytes, std::size_t count);

 private:
  std::filesystem::path folder_;
};

}  // namespace tidemark::fuzz
