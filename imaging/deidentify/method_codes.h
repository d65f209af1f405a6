// The attributes by which files say that they are de-identified. Private to this folder.
#pragma once

#include <string>
#include <vector>

#include "imaging/deidentify/options.h"

class DcmItem;

namespace tidemark::imaging {

// A code of the scheme DCM (DICOM PS3.16 CID 7050).
struct MethodCode {
  const char* value;
  const char* meaning;
};

// The profile's, and one for each option in use.
[[nodiscard]] std::vector<MethodCode> method_codes(const DeidentifyOptions& options);

// PatientIdentityRemoved (0012,0062), DeidentificationMethod (0012,0063) and its codes (0012,0064), and
// LongitudinalTemporalInformationModified (0028,0303): DICOM PS3.15 E.1.1. False when they cannot be set.
[[nodiscard]] bool put_method(DcmItem& dataset, const DeidentifyOptions& options);

}  // namespace tidemark::imaging
