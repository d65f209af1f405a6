// A stream for DCMTK over bytes that were checked. By its name DCMTK would open the file a second time, and
// find there what somebody has put in its place meanwhile.
#pragma once

#include <string>

#include "imaging/dicom/byte_source.h"
#include "imaging/dicom/transfer_syntaxes.h"

class DcmFileFormat;

namespace tidemark {

// Parses all bytes, in that transfer syntax; long values are read when they are asked for, so that the bytes
// must outlive `loaded`. Returns what is wrong, in DCMTK's words; empty when nothing is.
[[nodiscard]] std::string parse_dicom(ByteSource& bytes, const TransferSyntax& syntax, DcmFileFormat& loaded);

}  // namespace tidemark
