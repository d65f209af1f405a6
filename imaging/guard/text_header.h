// Headers of text lines: NRRD and MetaImage.
#pragma once

#include <initializer_list>

#include "imaging/guard/pixel_layout.h"

namespace tidemark::imaging::files {

// Both fail (ErrorKind::input) when the file is not of that format or its header does not end within 1 MiB.
// "name: value" up to an empty line; names in lower case.
Result<TextHeader> read_nrrd_header(const std::filesystem::path& file);
// "name = value" up to ElementDataFile; the case of names counts, as in ITK's reader. Lines that this reader
// would understand otherwise are refused.
Result<TextHeader> read_meta_header(const std::filesystem::path& file);

// Refuses the fields of these names that hold anything but finite numbers, brackets and commas ("none" stands
// for an axis that is not in space). ITK's matrix library ends the program when it is given a NaN.
Status require_finite_fields(const TextHeader& header, const std::filesystem::path& file,
                             std::initializer_list<const char*> names);

}  // namespace tidemark::imaging::files
