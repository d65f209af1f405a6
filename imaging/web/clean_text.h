// Text from a server for a message or a list: one line of whole characters, whatever came.
#pragma once

#include <string>

namespace tidemark::imaging {

// On one line, without blanks around it, at most 512 bytes of whole UTF-8 characters; what is not UTF-8
// becomes question marks.
[[nodiscard]] std::string clean_text(const std::string& text);

}  // namespace tidemark::imaging
