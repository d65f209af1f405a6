// From a DICOM file to a SliceHeader, and what stands before DCMTK for files of other kinds.
#pragma once

#include <filesystem>
#include <memory>

#include "core/result.h"
#include "imaging/dicom/slice_header.h"

class DcmFileFormat;

namespace tidemark {

struct TransferSyntax;

struct OpenedSlice {
  OpenedSlice(SliceHeader known, std::unique_ptr<DcmFileFormat> parsed);
  ~OpenedSlice();
  OpenedSlice(OpenedSlice&&) noexcept;

  SliceHeader header;
  // As DCMTK parsed it, pixel data still on the disk; null when the preflight refused that, which is then the
  // header's problem.
  std::unique_ptr<DcmFileFormat> loaded;
};

// Checks the file (preflight.h) and parses it. Fails (ErrorKind::input) when the file is not a DICOM image;
// an image that cannot be a slice of a volume is returned with its problem.
[[nodiscard]] Result<OpenedSlice> open_slice(const std::filesystem::path& file);
[[nodiscard]] Result<SliceHeader> read_slice_header(const std::filesystem::path& file);

// For files of other kinds: the transfer syntax as which DCMTK may parse the file. Fails (ErrorKind::input)
// when it is no DICOM file, or the preflight refuses it.
[[nodiscard]] Result<const TransferSyntax*> syntax_to_parse(const std::filesystem::path& file);

}  // namespace tidemark
