// DICOM files that hold no plain images, in and out. Private to this folder.
#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "core/geometry.h"
#include "core/result.h"
#include "imaging/dicom/element_text.h"
#include "imaging/dicom/parsed_dicom.h"

namespace tidemark::imaging {

// The file, checked and parsed, its text in UTF-8. `stop_at` ends the reading there (the pixel data, say).
// Fails with ErrorKind::input.
Result<ParsedDicom> load_object(const std::filesystem::path& file, std::optional<DicomTag> stop_at = {});

// The same of a whole file with results, whose voxels will be used: audited (AuditEvent::Kind::imported).
Result<ParsedDicom> load_result(const std::filesystem::path& file);

// SOPClassUID (0008,0016); empty where it cannot be read.
[[nodiscard]] std::string sop_class_of(const std::filesystem::path& file);

// Calls visit(item), which returns a Status, for each item of a sequence until one fails; for none where it
// is absent. Asked for an item by its number, DCMTK would count from the first one each time.
template <class Visit>
Status for_each_item(DcmItem& parent, const DcmTagKey& key, const Visit& visit) {
  DcmSequenceOfItems* sequence = nullptr;
  if (parent.findAndGetSequence(key, sequence).bad() || sequence == nullptr) return {};
  for (DcmObject* item = sequence->nextInContainer(nullptr); item != nullptr;
       item = sequence->nextInContainer(item)) {
    TIDEMARK_TRY(visit(*static_cast<DcmItem*>(item)));
  }
  return {};
}

// Encodes the dataset and writes it as the whole of the file. Fails with ErrorKind::write.
Status save_object(std::unique_ptr<DcmDataset> dataset, E_TransferSyntax syntax,
                   const std::filesystem::path& file);

// Remembers the first of many calls that failed.
class FirstFailure {
 public:
  FirstFailure& operator<<(const OFCondition& condition) {
    if (first_.good()) first_ = condition;
    return *this;
  }
  [[nodiscard]] Status status(const std::filesystem::path& file) const {
    if (first_.good()) return {};
    return fail(ErrorKind::write, "{}: cannot write: {}", file.string(), first_.text());
  }

 private:
  OFCondition first_ = EC_Normal;
};

inline OFString text_of(const std::string& text) {
  return {text.c_str()};
}

// The colour of segments without one; systems that read them expect a colour.
constexpr std::array<std::uint8_t, 3> kDefaultColour{255, 255, 0};

// Gives an object of DCMTK's the patient and the study of another one.
template <class Object>
void copy_patient_and_study(DcmItem& from, Object& to, FirstFailure& failure) {
  const auto copied = [&](const DcmTagKey& key) { return text_of(element_text(from, key)); };
  failure << to.setPatientName(copied(DCM_PatientName), OFFalse);
  failure << to.setPatientID(copied(DCM_PatientID), OFFalse);
  failure << to.setPatientBirthDate(copied(DCM_PatientBirthDate), OFFalse);
  failure << to.setPatientSex(copied(DCM_PatientSex), OFFalse);
  failure << to.setStudyDate(copied(DCM_StudyDate), OFFalse);
  failure << to.setStudyTime(copied(DCM_StudyTime), OFFalse);
  failure << to.setStudyID(copied(DCM_StudyID), OFFalse);
  failure << to.setStudyDescription(copied(DCM_StudyDescription), OFFalse);
  failure << to.setAccessionNumber(copied(DCM_AccessionNumber), OFFalse);
  failure << to.setReferringPhysicianName(copied(DCM_ReferringPhysicianName), OFFalse);
}

// Whether slices of the grid can be DICOM image planes: columns and rows within 65535, orthonormal
// directions. Fails with ErrorKind::capability.
Status require_planes(const Geometry& geometry, const std::filesystem::path& file);

}  // namespace tidemark::imaging
