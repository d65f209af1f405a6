// DCMTK over bytes that were checked. By the file's name it would open it a second time, and find there what
// somebody has put in its place meanwhile.
#pragma once

#include <optional>
#include <string>

#include "imaging/dicom/byte_source.h"
#include "imaging/dicom/tag_walk.h"
#include "imaging/dicom/transfer_syntaxes.h"

class DcmFileFormat;

namespace tidemark {

// Parses the bytes in that transfer syntax, all or those before the element `stop_at`; long values are read
// when they are asked for, so that the bytes must outlive `loaded`. Returns what is wrong, in DCMTK's words;
// empty when nothing is.
[[nodiscard]] std::string parse_dicom(ByteSource& bytes, const TransferSyntax& syntax, DcmFileFormat& loaded,
                                      std::optional<DicomTag> stop_at = {});

}  // namespace tidemark
