// The codes of measures for structured reports (SNOMED CT, DCM, UCUM and IBSI).
#pragma once

#include <string>
#include <vector>

#include "document/measures.h"
#include "imaging/results/measurement_report.h"

namespace tidemark::document {

// Volume, diameters, area and sphericity; of the first image its values, where its modality (CT, MR or PT in
// standardised uptake values) has a code for what they are.
[[nodiscard]] std::vector<imaging::ReportedMeasure> coded(const Measures& measures,
                                                          const std::string& modality);

}  // namespace tidemark::document
