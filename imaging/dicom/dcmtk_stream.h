// A stream for DCMTK over bytes that were checked. By its name DCMTK would open the file a second time, and
// find there what somebody has put in its place meanwhile.
#pragma once

#include <optional>
#include <string>

#include "imaging/guard/byte_source.h"
#include "imaging/guard/dicom/tag_walk.h"
#include "imaging/guard/dicom/transfer_syntaxes.h"

class DcmFileFormat;

namespace tidemark::imaging {

// Parses the bytes in that transfer syntax, all or those before the element `stop_at`. Long values are read
// on demand, so that the bytes must outlive `loaded`. Returns the error in DCMTK's words; empty when there is
// none.
[[nodiscard]] std::string parse_dicom(ByteSource& bytes, const TransferSyntax& syntax, DcmFileFormat& loaded,
                                      std::optional<DicomTag> stop_at = {});

}  // namespace tidemark::imaging
