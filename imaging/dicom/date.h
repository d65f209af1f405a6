// Dates of DICOM attributes.
#pragma once

#include <string>

namespace tidemark::imaging {

// "20040731", or "2004.07.31" of files older than DICOM 3 (PS3.5 6.2), as "2004-07-31"; empty when it is
// none. A date's digits are checked, not the calendar.
[[nodiscard]] std::string iso_date(std::string text);

// The time between two such dates in years, months or days, as DICOM writes ages: "45Y". Empty where a date
// is not in the calendar, or the age is beyond any person's.
[[nodiscard]] std::string age_between(const std::string& birth, const std::string& study);

}  // namespace tidemark::imaging
