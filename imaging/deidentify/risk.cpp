#include "imaging/deidentify/risk.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "imaging/dicom/attribute_reader.h"
#include "imaging/dicom/element_text.h"

namespace tidemark::imaging {
namespace {

// DICOM PS3.4 B.5, PS3.6 A.
constexpr std::string_view kSecondaryCaptures = "1.2.840.10008.5.1.4.1.1.7";
constexpr std::string_view kUltrasound[] = {"1.2.840.10008.5.1.4.1.1.3", "1.2.840.10008.5.1.4.1.1.6"};
// Visible light: photographs, endoscopy, microscopy, dermoscopy.
constexpr std::string_view kPhotographs = "1.2.840.10008.5.1.4.1.1.77.1";
// Of these: the eye from near by, and tissue, whose label an attribute tells.
constexpr std::string_view kHarmlessPhotographs[] = {"1.2.840.10008.5.1.4.1.1.77.1.5",
                                                     "1.2.840.10008.5.1.4.1.1.77.1.6"};
constexpr std::string_view kDocuments[] = {"1.2.840.10008.5.1.4.1.1.88",    // structured reports
                                           "1.2.840.10008.5.1.4.1.1.104",   // PDF, CDA, STL, ...
                                           "1.2.840.10008.5.1.4.1.1.9.4"};  // voice

// Of the class itself, or a class below it.
bool is_of(std::string_view uid, std::string_view family) {
  return uid.starts_with(family) && (uid.size() == family.size() || uid[family.size()] == '.');
}

template <std::size_t count>
bool is_of_any(std::string_view uid, const std::string_view (&families)[count]) {
  return std::any_of(std::begin(families), std::end(families),
                     [&](std::string_view family) { return is_of(uid, family); });
}

std::string class_name(const std::string& uid) {
  const char* name = dcmFindNameOfUID(uid.c_str());
  return name != nullptr ? name : uid;
}

std::string risk_of(const DcmTagKey& key, std::string_view value) {
  return fmt::format("{} is {}: its pixels may show who it is", name_of(key), value);
}

// Overlays of old files lie in bits of the pixels that hold no brightness (retired: PS3.3-2004 C.9.2).
bool has_overlay_in_pixels(DcmDataset& dataset, DcmTagKey& where) {
  for (Uint16 group = 0x6000; group <= 0x601e; group = static_cast<Uint16>(group + 2)) {
    where = DcmTagKey(group, 0x0102);
    Uint16 bit = 0;
    if (dataset.findAndGetUint16(where, bit).good() && bit != 0) return true;
  }
  return false;
}

}  // namespace

std::string pixel_risk(DcmDataset& dataset) {
  for (const DcmTagKey& key :
       {DCM_BurnedInAnnotation, DCM_RecognizableVisualFeatures, DCM_SpecimenLabelInImage}) {
    if (element_text(dataset, key) == "YES") return risk_of(key, "YES");
  }
  const std::string uid = element_text(dataset, DCM_SOPClassUID);
  if (is_of(uid, kSecondaryCaptures)) return risk_of(DCM_SOPClassUID, class_name(uid));
  const std::string conversion = element_text(dataset, DCM_ConversionType);
  if (!conversion.empty()) return risk_of(DCM_ConversionType, conversion.substr(0, 16));
  if (element_text(dataset, DCM_ImageType).find("SCREEN") != std::string::npos) {
    return risk_of(DCM_ImageType, "SCREEN");
  }
  const bool denies_text = element_text(dataset, DCM_BurnedInAnnotation) == "NO";
  const bool denies_face = element_text(dataset, DCM_RecognizableVisualFeatures) == "NO";
  const bool is_photograph = is_of(uid, kPhotographs) && !is_of_any(uid, kHarmlessPhotographs);
  if ((is_of_any(uid, kUltrasound) && !denies_text) || (is_photograph && !(denies_text && denies_face))) {
    return risk_of(DCM_SOPClassUID, class_name(uid));
  }
  DcmTagKey overlay;
  if (has_overlay_in_pixels(dataset, overlay)) return risk_of(overlay, "not 0");
  return {};
}

std::string document_reason(DcmDataset& dataset) {
  const std::string uid = element_text(dataset, DCM_SOPClassUID);
  const auto reason = [](const DcmTagKey& key, std::string_view value) {
    return fmt::format("{} is {}: what it says cannot be de-identified", name_of(key), value);
  };
  if (is_of_any(uid, kDocuments)) return reason(DCM_SOPClassUID, class_name(uid));
  for (const DcmTagKey& key : {DCM_EncapsulatedDocument, DCM_ContentSequence}) {
    if (dataset.tagExists(key)) return reason(key, "there");
  }
  return {};
}

bool is_directory_object(DcmDataset& dataset) {
  return dataset.tagExists(DCM_DirectoryRecordSequence);
}

}  // namespace tidemark::imaging
