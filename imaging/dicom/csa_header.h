// Siemens' CSA header, a table of named values within the private element (0029,xx10).
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace tidemark::imaging {

// The numbers under that name; none where the table is damaged before it, has no such name, or holds no
// numbers there. Reads each byte at most once and no byte beyond the end.
[[nodiscard]] std::vector<double> csa_numbers(std::span<const std::uint8_t> header, std::string_view name);

}  // namespace tidemark::imaging
