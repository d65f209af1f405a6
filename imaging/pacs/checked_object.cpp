#include "imaging/pacs/checked_object.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include "imaging/dicom/dicom_setup.h"
#include "imaging/dicom/read_patient.h"
#include "imaging/guard/guarded.h"
#include "imaging/pacs/services.h"
#include "imaging/pacs/storage_classes.h"

namespace tidemark::imaging {
namespace {

namespace fs = std::filesystem;

// The attributes that are read come before it; whether those behind it are sound the preflight has seen.
constexpr DicomTag kAfterIdentity{0x0020, 0x0010};

Result<ObjectIdentity> identity_of(const ParsedDicom& object, const fs::path& file) {
  DcmDataset& dataset = object.dataset();
  const auto text = [&](const DcmTagKey& key) {
    OFString value;
    return dataset.findAndGetOFString(key, value).good() ? std::string(value.c_str()) : std::string();
  };
  ObjectIdentity identity;
  identity.sop_class = text(DCM_SOPClassUID);
  identity.sop_instance = text(DCM_SOPInstanceUID);
  identity.study = text(DCM_StudyInstanceUID);
  identity.series = text(DCM_SeriesInstanceUID);
  identity.audited = read_audited_study(dataset);
  identity.transfer_syntax = DcmXfer(dataset.getOriginalXfer()).getXferID();
  for (const auto& [name, value] : {std::pair{"SOPClassUID (0008,0016)", &identity.sop_class},
                                    {"SOPInstanceUID (0008,0018)", &identity.sop_instance},
                                    {"StudyInstanceUID (0020,000D)", &identity.study},
                                    {"SeriesInstanceUID (0020,000E)", &identity.series}}) {
    if (!is_uid(*value)) return fail(ErrorKind::input, "{}: {} is missing or no UID", file.string(), name);
  }
  return identity;
}

Result<CheckedObject> open_object(const fs::path& file, std::optional<DicomTag> stop_at) {
  TIDEMARK_TRY(set_up_dicom());
  auto parsed = ParsedDicom::open(file, stop_at);
  if (!parsed) return pass_on(parsed);
  auto identity = identity_of(*parsed, file);
  if (!identity) return pass_on(identity);
  return CheckedObject{std::move(*identity), std::move(*parsed)};
}

}  // namespace

Result<ObjectIdentity> check_object(const fs::path& file) {
  return guarded(file, [&]() -> Result<ObjectIdentity> {
    auto object = open_object(file, kAfterIdentity);
    if (!object) return pass_on(object);
    return std::move(object->identity);
  });
}

Result<CheckedObject> load_checked_object(const fs::path& file) {
  return guarded(file, [&] { return open_object(file, {}); });
}

}  // namespace tidemark::imaging
