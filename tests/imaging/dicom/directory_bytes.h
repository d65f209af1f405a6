// DICOMDIRs byte by byte.
#pragma once

#include <string>
#include <vector>

#include "tests/imaging/dicom/dicom_bytes.h"

namespace tidemark::test {

// A record of that type ("IMAGE"), in use, with further elements.
std::string directory_record(const char* type, const std::string& rest);

// Of one series, each image's file by its name with backslashes.
std::string directory_bytes(const std::string& series_uid, const std::vector<std::string>& names);

}  // namespace tidemark::test
