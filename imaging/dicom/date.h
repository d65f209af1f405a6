// Dates of DICOM attributes.
#pragma once

#include <string>

namespace tidemark {

// "20040731", or "2004.07.31" of files older than DICOM 3 (PS3.5 6.2), as "2004-07-31"; empty when it is
// none. A date's digits are checked, not the calendar.
[[nodiscard]] std::string iso_date(std::string text);

// In years, months or days, as DICOM writes ages: "45Y"; two such dates. Empty where one is not in the
// calendar, or nobody is as old.
[[nodiscard]] std::string age_between(const std::string& birth, const std::string& study);

}  // namespace tidemark
