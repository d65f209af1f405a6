// A small file as text.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "core/result.h"

namespace tidemark {

// Fails (ErrorKind::input) naming the file where it cannot be read or has more than `most` bytes.
Result<std::string> read_text_file(const std::filesystem::path& file, std::size_t most);

}  // namespace tidemark
