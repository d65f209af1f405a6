// Dates that are moved by whole days.
#pragma once

#include <string>

namespace tidemark::imaging {

// Farther than the dates of any study.
inline constexpr int kMostShiftDays = 36'500;

// Dates or moments (DA, DT: DICOM PS3.5 6.2) of an element, with backslashes between them, each moved by
// `days`; what follows the day stays. "2004.07.31" of files older than DICOM 3 becomes a date of today's
// form. A value that has no day of the calendar becomes empty.
[[nodiscard]] std::string shifted_dates(const std::string& values, int days);

}  // namespace tidemark::imaging
