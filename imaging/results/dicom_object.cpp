#include "imaging/results/dicom_object.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "imaging/dicom/character_sets.h"
#include "imaging/dicom/dicom_setup.h"
#include "imaging/dicom/read_patient.h"
#include "imaging/dicom/write_dicom_file.h"
#include "imaging/results/results.h"

namespace tidemark::imaging {

namespace fs = std::filesystem;

namespace {

constexpr const char* kUtf8 = "ISO_IR 192";

// Text that is too long to be read by anyone stays as it is.
void convert_element(DcmElement& element, const std::string& character_set) {
  const DcmVR vr(element.ident());
  char* bytes = nullptr;
  Uint32 length = 0;
  if (!vr.isAffectedBySpecificCharacterSet() || element.getLength() > kLongestText ||
      element.getString(bytes, length).bad() || bytes == nullptr) {
    return;
  }
  const std::string before(bytes, length);
  const std::string after = in_utf8_or_latin_1(before, character_set, vr.getDelimiterChars().c_str());
  if (after != before) element.putString(after.data(), static_cast<Uint32>(after.size()));
}

// All text of an item and of the items below it, which have its character set unless they name their own.
// DCMTK's convertToUTF8() asks the C library for tables of Japanese that it does not have.
void convert_text(DcmItem& item, std::string character_set) {
  const bool has_own = item.tagExists(DCM_SpecificCharacterSet);
  if (has_own) character_set = element_text(item, DCM_SpecificCharacterSet);
  for (DcmObject* one = nullptr; (one = item.nextInContainer(one)) != nullptr;) {
    if (one->ident() != EVR_SQ) {
      convert_element(static_cast<DcmElement&>(*one), character_set);
      continue;
    }
    auto& sequence = static_cast<DcmSequenceOfItems&>(*one);
    for (DcmObject* below = nullptr; (below = sequence.nextInContainer(below)) != nullptr;) {
      convert_text(static_cast<DcmItem&>(*below), character_set);
    }
  }
  if (has_own) item.putAndInsertString(DCM_SpecificCharacterSet, kUtf8);
}

}  // namespace

Result<ParsedDicom> load_object(const fs::path& file, std::optional<DicomTag> stop_at) {
  TIDEMARK_TRY(set_up_dicom());
  auto parsed = ParsedDicom::open(file, stop_at);
  if (!parsed) return parsed;
  DcmDataset& dataset = parsed->dataset();
  convert_text(dataset, {});
  dataset.putAndInsertString(DCM_SpecificCharacterSet, kUtf8);
  return parsed;
}

Result<ParsedDicom> load_result(const fs::path& file) {
  auto object = load_object(file);
  if (!object) return object;
  record_audit({.kind = AuditEvent::Kind::imported,
                .study = read_audited_study(object->dataset()),
                .files = {fs::absolute(file)}});
  return object;
}

Status save_object(std::unique_ptr<DcmDataset> dataset, E_TransferSyntax syntax, const fs::path& file) {
  DcmFileFormat whole(dataset.release(), OFFalse);  // which owns it now
  return write_dicom_file(whole, syntax, file);
}

Status require_planes(const Geometry& geometry, const fs::path& file) {
  const auto refuse = [&](const char* why) {
    return fail(ErrorKind::capability, "{}: DICOM cannot say this grid: {}", file.string(), why);
  };
  const Index3 size = geometry.size;
  if (size.x < 1 || size.y < 1 || size.z < 1 || size.x > 65535 || size.y > 65535) {
    return refuse("its size is not within 1..65535 columns and rows");
  }
  const auto& d = geometry.direction;
  if (!(std::abs(std::abs(glm::dot(glm::cross(d[0], d[1]), d[2])) - 1.0) < 1e-4)) {
    return refuse("its directions are not orthonormal");
  }
  return {};
}

std::string sop_class_of(const fs::path& file) {
  constexpr DicomTag kPatientName{0x0010, 0x0010};  // comes after the SOP class
  const auto object = load_object(file, kPatientName);
  return object ? element_text(object->dataset(), DCM_SOPClassUID) : std::string();
}

std::optional<ResultForm> result_form_of(const fs::path& file) {
  const std::string sop_class = sop_class_of(file);
  if (sop_class == UID_SegmentationStorage) return ResultForm::segmentation;
  if (sop_class == UID_RTStructureSetStorage) return ResultForm::structure_set;
  return std::nullopt;
}

Status spare_study_file(const fs::path& file) {
  constexpr const char* kReports =
      "1.2.840.10008.5.1.4.1.1.88.";  // structured, and selections of key objects
  const std::string sop_class = sop_class_of(file);
  if (sop_class.empty() || sop_class == UID_SegmentationStorage || sop_class == UID_RTStructureSetStorage ||
      sop_class == UID_GrayscaleSoftcopyPresentationStateStorage || sop_class.starts_with(kReports))
    return {};
  return fail(ErrorKind::usage,
              "{}: is a file of a study, which is never written to; choose another name for the result",
              file.string());
}

std::string study_uid_of(const fs::path& file) {
  constexpr DicomTag kSeriesInstanceUid{0x0020, 0x000e};  // the next one
  const auto object = load_object(file, kSeriesInstanceUid);
  return object ? element_text(object->dataset(), DCM_StudyInstanceUID) : std::string();
}

}  // namespace tidemark::imaging
