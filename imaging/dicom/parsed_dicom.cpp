#include "imaging/dicom/parsed_dicom.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <utility>

#include "imaging/dicom/dcmtk_stream.h"

namespace tidemark::imaging {

namespace fs = std::filesystem;

ParsedDicom::ParsedDicom(CheckedDicom opened)
    : opened_(std::move(opened)), format_(std::make_unique<DcmFileFormat>()) {}
ParsedDicom::~ParsedDicom() = default;
ParsedDicom::ParsedDicom(ParsedDicom&&) noexcept = default;

ParsedDicom& ParsedDicom::operator=(ParsedDicom&& other) noexcept {
  format_ = std::move(other.format_);  // first, as it refers to what is opened
  opened_ = std::move(other.opened_);
  return *this;
}

Result<ParsedDicom> ParsedDicom::open(const fs::path& file, std::optional<DicomTag> stop_at) {
  auto checked = check_dicom_to_parse(file);
  if (!checked) return pass_on(checked);
  return parse(std::move(*checked), file, stop_at);
}

Result<ParsedDicom> ParsedDicom::parse(CheckedDicom checked, const fs::path& file,
                                       std::optional<DicomTag> stop_at) {
  ParsedDicom parsed(std::move(checked));
  const std::string problem = parse_dicom(*parsed.opened_.bytes, parsed.syntax(), *parsed.format_, stop_at);
  if (!problem.empty()) return fail(ErrorKind::input, "{}: is damaged: {}", file.string(), problem);
  return parsed;
}

DcmDataset& ParsedDicom::dataset() const {
  return *format_->getDataset();
}

std::unique_ptr<DcmFileFormat> ParsedDicom::take() {
  format_->loadAllDataIntoMemory();
  return std::move(format_);
}

}  // namespace tidemark::imaging
