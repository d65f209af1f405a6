#include "imaging/results/dicom_object.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "imaging/dicom/dicom_setup.h"
#include "imaging/dicom/header_reader.h"
#include "imaging/dicom/transfer_syntaxes.h"
#include "imaging/dicom/write_dicom_file.h"
#include "imaging/results/results.h"

namespace tidemark {

namespace fs = std::filesystem;

Result<std::unique_ptr<DcmFileFormat>> load_object(const fs::path& file, const DcmTagKey& stop_at) {
  TIDEMARK_TRY(set_up_dicom());
  const auto syntax = syntax_to_parse(file);
  if (!syntax) return tl::unexpected<Error>(syntax.error());
  auto loaded = std::make_unique<DcmFileFormat>();
  const OFCondition parsed =
      loaded->loadFileUntilTag(file.c_str(), DcmXfer(std::string((*syntax)->uid).c_str()).getXfer(),
                               EGL_noChange, DCM_MaxReadLength, ERM_autoDetect, stop_at);
  if (parsed.bad()) return fail(ErrorKind::input, "{}: is damaged: {}", file.string(), parsed.text());
  // Where the character set is missing or wrong the text is taken as Latin-1, which has a letter for each
  // byte.
  DcmDataset& dataset = *loaded->getDataset();
  if (dataset.convertToUTF8().bad()) {
    dataset.putAndInsertString(DCM_SpecificCharacterSet, "ISO_IR 100");
    dataset.convertToUTF8();
  }
  return loaded;
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

std::optional<ResultForm> result_form_of(const fs::path& file) {
  // The SOP class is among the first attributes; the patient's come after it.
  const auto object = load_object(file, DCM_PatientName);
  if (!object) return std::nullopt;
  const std::string sop_class = element_text(*(*object)->getDataset(), DCM_SOPClassUID);
  if (sop_class == UID_SegmentationStorage) return ResultForm::segmentation;
  if (sop_class == UID_RTStructureSetStorage) return ResultForm::structure_set;
  return std::nullopt;
}

}  // namespace tidemark
