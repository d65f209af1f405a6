// A DICOM file that was checked and then parsed by DCMTK, both through one descriptor.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "core/result.h"
#include "imaging/dicom/checked_dicom.h"

class DcmDataset;
class DcmFileFormat;

namespace tidemark::imaging {

class ParsedDicom {
 public:
  // Opens, checks and parses the file, up to the element `stop_at` where that is given. Fails
  // (ErrorKind::input) naming the file.
  static Result<ParsedDicom> open(const std::filesystem::path& file, std::optional<DicomTag> stop_at = {});
  // Of a file that may be parsed; `file` is for the message.
  static Result<ParsedDicom> parse(CheckedDicom checked, const std::filesystem::path& file,
                                   std::optional<DicomTag> stop_at = {});
  ~ParsedDicom();
  ParsedDicom(ParsedDicom&&) noexcept;
  ParsedDicom& operator=(ParsedDicom&&) noexcept;

  // Long values are read from the file when they are asked for.
  [[nodiscard]] DcmDataset& dataset() const;
  [[nodiscard]] DcmFileFormat& format() const { return *format_; }
  [[nodiscard]] const TransferSyntax& syntax() const { return *opened_.checked.syntax; }
  [[nodiscard]] const Preflight& checked() const { return opened_.checked; }
  [[nodiscard]] ByteSource& bytes() const { return *opened_.bytes; }

  // All of it, with nothing left in the file.
  [[nodiscard]] std::unique_ptr<DcmFileFormat> take();

 private:
  explicit ParsedDicom(CheckedDicom opened);
  CheckedDicom opened_;
  std::unique_ptr<DcmFileFormat> format_;  // refers to what is opened
};

}  // namespace tidemark::imaging
