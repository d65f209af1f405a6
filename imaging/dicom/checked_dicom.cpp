#include "imaging/dicom/checked_dicom.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include "imaging/dicom/attribute_reader.h"
#include "imaging/dicom/detect.h"

namespace tidemark::imaging {

namespace fs = std::filesystem;

Result<CheckedDicom> check_dicom(const fs::path& file) {
  auto bytes = FileBytes::open(file);
  if (!bytes) return pass_on(bytes);
  Preflight checked;
  if (begins_as_dicom(*bytes)) {
    checked = preflight_dicom(*bytes);
  } else {
    checked.verdict = Preflight::Verdict::not_dicom;
  }
  return CheckedDicom{std::make_unique<FileBytes>(std::move(*bytes)), std::move(checked)};
}

Result<CheckedDicom> check_dicom_to_parse(const fs::path& file) {
  auto opened = check_dicom(file);
  if (!opened || opened->checked.may_be_parsed()) return opened;
  return fail(ErrorKind::input, "{}: {}", file.string(), describe(opened->checked));
}

std::string describe(const Preflight& checked) {
  if (checked.verdict == Preflight::Verdict::not_dicom) return "is not a DICOM file";
  const auto& [tag, offset, what] = checked.reason;
  const std::string element = tag == DicomTag{} ? "the dataset" : name_of(DcmTagKey(tag.group, tag.element));
  const bool is_damaged = checked.verdict == Preflight::Verdict::damaged;
  return fmt::format("{}{} {} (at byte {})", is_damaged ? "is damaged: " : "", element, what, offset);
}

}  // namespace tidemark::imaging
