// The one writer of DICOM files.
#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcfilefo.h>

#include <filesystem>

#include "core/result.h"

namespace tidemark::imaging {

// Encodes it and writes it whole or not at all. Fails with ErrorKind::write.
Status write_dicom_file(DcmFileFormat& object, E_TransferSyntax syntax, const std::filesystem::path& file);

}  // namespace tidemark::imaging
