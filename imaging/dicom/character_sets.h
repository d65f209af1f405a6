// Text of DICOM attributes, whatever character set it is in.
#pragma once

#include <string>
#include <string_view>

namespace tidemark::imaging {

// UTF-8 of `text`, which is in `character_set` (0008,0005). `delimiters`: characters after which the default
// character set holds again (PS3.5 6.1.2.5.3), "^=" in names of persons. Bytes that are no characters become
// question marks.
[[nodiscard]] std::string in_utf8(std::string text, const std::string& character_set,
                                  const std::string& delimiters = {});

// Likewise, but where the set is missing or wrong the text counts as Latin-1. That has a letter for each
// byte, so that different texts stay different.
[[nodiscard]] std::string in_utf8_or_latin_1(std::string text, const std::string& character_set,
                                             const std::string& delimiters = {});

// UTF-8 without blanks and padding around it, in one line, of a length that can be shown.
[[nodiscard]] std::string tidied(std::string_view text);

}  // namespace tidemark::imaging
