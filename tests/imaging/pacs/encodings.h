// Files in other transfer syntaxes.
#pragma once

#include <QString>
#include <filesystem>

namespace tidemark::test {

// Losslessly, by runs. Ends the test program when that fails.
void compress_by_rle(const std::filesystem::path& file, const std::filesystem::path& target);

// The UID of a file's transfer syntax.
QString syntax_of(const std::filesystem::path& file);

}  // namespace tidemark::test
