#include "imaging/pacs/storage_classes.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcuid.h>

#include <algorithm>

namespace tidemark::imaging {
namespace {

// Whose pixels may come compressed.
const std::vector<std::string> kImages{
    UID_CTImageStorage,
    UID_EnhancedCTImageStorage,
    UID_MRImageStorage,
    UID_EnhancedMRImageStorage,
    UID_PositronEmissionTomographyImageStorage,
    UID_EnhancedPETImageStorage,
    UID_NuclearMedicineImageStorage,
    UID_XRay3DAngiographicImageStorage,
    UID_SecondaryCaptureImageStorage,
    UID_MultiframeGrayscaleWordSecondaryCaptureImageStorage,
};
const std::vector<std::string> kOthers{
    UID_LegacyConvertedEnhancedCTImageStorage,
    UID_LegacyConvertedEnhancedMRImageStorage,
    UID_LegacyConvertedEnhancedPETImageStorage,
    UID_SegmentationStorage,
    UID_RTStructureSetStorage,
};
const std::vector<std::string> kPlain{UID_LittleEndianExplicitTransferSyntax,
                                      UID_LittleEndianImplicitTransferSyntax};
const std::vector<std::string> kCompressed{
    UID_JPEGProcess14SV1TransferSyntax,
    UID_JPEGLSLosslessTransferSyntax,
    UID_JPEG2000LosslessOnlyTransferSyntax,
    UID_RLELosslessTransferSyntax,
    UID_JPEGProcess14TransferSyntax,
    UID_JPEGProcess1TransferSyntax,
    UID_JPEGProcess2_4TransferSyntax,
    UID_JPEGLSLossyTransferSyntax,
    UID_JPEG2000TransferSyntax,
};

std::vector<std::string> joined(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  std::vector<std::string> both = a;
  both.insert(both.end(), b.begin(), b.end());
  return both;
}

}  // namespace

const std::vector<std::string>& storage_classes() {
  static const std::vector<std::string> kAll = joined(kImages, kOthers);
  return kAll;
}

const std::vector<std::string>& storage_syntaxes() {
  static const std::vector<std::string> kAll = joined(kPlain, kCompressed);
  return kAll;
}

bool is_storage_class(const std::string& uid) {
  return std::find(storage_classes().begin(), storage_classes().end(), uid) != storage_classes().end();
}

std::vector<Proposal> storage_proposals() {
  std::vector<Proposal> proposals;
  for (const std::string& one : storage_classes()) proposals.push_back({one, kPlain, true});
  for (const std::string& syntax : kCompressed) {
    for (const std::string& image : kImages) proposals.push_back({image, {syntax}, true});
  }
  return proposals;
}

}  // namespace tidemark::imaging
