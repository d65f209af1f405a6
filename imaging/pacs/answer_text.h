// Text out of a server's answers, which may hold anything.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::imaging {

// The parts between the separators, empty ones, too.
[[nodiscard]] std::vector<std::string> split(const std::string& text, char separator);

// "2004-07-31" of "20040731" or "2004.07.31"; empty when it is no date.
[[nodiscard]] std::string date_text(std::string text);

// "20040731" of "2004-07-31" or "20040731"; nothing when it is no date.
[[nodiscard]] std::optional<std::string> dicom_date(std::string_view text);

// A whole number >= 0; nothing when it is none.
[[nodiscard]] std::optional<std::int64_t> count_of(std::string_view text);

}  // namespace tidemark::imaging
