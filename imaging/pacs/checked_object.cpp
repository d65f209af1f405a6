#include "imaging/pacs/checked_object.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include "imaging/dicom/dicom_setup.h"
#include "imaging/dicom/header_reader.h"
#include "imaging/dicom/transfer_syntaxes.h"
#include "imaging/guard/guarded.h"
#include "imaging/pacs/storage_classes.h"

namespace tidemark {
namespace {

namespace fs = std::filesystem;

// The attributes that are read come before it; whether those behind it are sound the preflight has seen.
const DcmTagKey kAfterIdentity(0x0020, 0x0010);

Result<ObjectIdentity> identity_of(const fs::path& file, const TransferSyntax& syntax) {
  DcmFileFormat loaded;
  const OFCondition parsed =
      loaded.loadFileUntilTag(file.c_str(), DcmXfer(std::string(syntax.uid).c_str()).getXfer(), EGL_noChange,
                              DCM_MaxReadLength, ERM_autoDetect, kAfterIdentity);
  if (parsed.bad()) return fail(ErrorKind::input, "{}: is damaged: {}", file.string(), parsed.text());
  DcmDataset& dataset = *loaded.getDataset();
  const auto text = [&](const DcmTagKey& key) {
    OFString value;
    return dataset.findAndGetOFString(key, value).good() ? std::string(value.c_str()) : std::string();
  };
  ObjectIdentity identity;
  identity.sop_class = text(DCM_SOPClassUID);
  identity.sop_instance = text(DCM_SOPInstanceUID);
  identity.study = text(DCM_StudyInstanceUID);
  identity.series = text(DCM_SeriesInstanceUID);
  identity.transfer_syntax = DcmXfer(dataset.getOriginalXfer()).getXferID();
  for (const auto& [name, value] : {std::pair{"SOPClassUID (0008,0016)", &identity.sop_class},
                                    {"SOPInstanceUID (0008,0018)", &identity.sop_instance},
                                    {"StudyInstanceUID (0020,000D)", &identity.study},
                                    {"SeriesInstanceUID (0020,000E)", &identity.series}}) {
    if (!is_uid(*value)) return fail(ErrorKind::input, "{}: {} is missing or no UID", file.string(), name);
  }
  return identity;
}

}  // namespace

Result<ObjectIdentity> check_object(const fs::path& file) {
  return guarded(file, [&]() -> Result<ObjectIdentity> {
    TIDEMARK_TRY(set_up_dicom());
    const auto syntax = syntax_to_parse(file);
    if (!syntax) return tl::unexpected<Error>(syntax.error());
    return identity_of(file, **syntax);
  });
}

}  // namespace tidemark
