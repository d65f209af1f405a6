// The one writer of DICOM files.
#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcfilefo.h>

#include <filesystem>
#include <string>

#include "core/result.h"

namespace tidemark::imaging {

// Its bytes as a file, with preamble and meta header. Fails with ErrorKind::write, in DCMTK's words.
Result<std::string> encode_dicom_file(DcmFileFormat& object, E_TransferSyntax syntax);

// Encodes it and writes it whole or not at all. Fails with ErrorKind::write.
Status write_dicom_file(DcmFileFormat& object, E_TransferSyntax syntax, const std::filesystem::path& file);

}  // namespace tidemark::imaging
