// Decimal strings of DICOM, whatever the locale.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace tidemark::imaging {

// The values of a decimal string (DS, DICOM PS3.5 6.2), separated by backslashes and padded with blanks.
// Nothing when one of them is empty, not a number, or not a finite double ("1e400", "nan").
[[nodiscard]] std::optional<std::vector<double>> parse_decimals(std::string_view text);

// The same for whole numbers (IS).
[[nodiscard]] std::optional<std::vector<long long>> parse_integers(std::string_view text);

}  // namespace tidemark::imaging
