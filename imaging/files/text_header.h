// Headers of text lines: NRRD and MetaImage.
#pragma once

#include "imaging/files/pixel_layout.h"

namespace tidemark::files {

// Both fail (ErrorKind::input) when the file is not of that format or its header does not end within 1 MiB.
Result<TextHeader> read_nrrd_header(const std::filesystem::path& file);  // "name: value" up to an empty line
Result<TextHeader> read_meta_header(
    const std::filesystem::path& file);  // "name = value" up to ElementDataFile

}  // namespace tidemark::files
