// Objects that no change of attributes makes anonymous. Private to this folder.
#pragma once

#include <string>

class DcmDataset;

namespace tidemark::imaging {

// Why the pixels may show who it is: one line that names the attribute, without the file's name; empty when
// nothing says so. BurnedInAnnotation (0028,0301), RecognizableVisualFeatures (0028,0302) or
// SpecimenLabelInImage (0048,0010) is YES; secondary and screen captures; ultrasound and photographs that do
// not deny it; overlays in the pixels' upper bits (DICOM PS3.15 E.3.1, E.3.2).
[[nodiscard]] std::string pixel_risk(DcmDataset& dataset);

// Why the object is left out, in one line: it is a structured report, an encapsulated document or a recorded
// voice. Free text and speech cannot be de-identified by attributes.
[[nodiscard]] std::string document_reason(DcmDataset& dataset);

// A DICOMDIR: names of files and patients, and no object.
[[nodiscard]] bool is_directory_object(DcmDataset& dataset);

}  // namespace tidemark::imaging
