// The patient of a DICOM dataset.
#pragma once

#include <string>

#include "imaging/audit/event.h"
#include "imaging/patient.h"

class DcmItem;

namespace tidemark::imaging {

// `study_date`: iso_date() of it; the age follows from it and the date of birth where the file does not say
// it.
[[nodiscard]] Patient read_patient(DcmItem& dataset, const std::string& study_date);

// Whose study the object belongs to, with this one object.
[[nodiscard]] AuditedStudy read_audited_study(DcmItem& dataset);

}  // namespace tidemark::imaging
