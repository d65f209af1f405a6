// Words of commands that users give to a shell.
#pragma once

#include <string>
#include <string_view>

namespace tidemark::cli {

// The text as one word, in single quotes where a shell would take it for anything else.
[[nodiscard]] std::string shell_word(std::string_view text);

}  // namespace tidemark::cli
