// A DICOM file that is open and was checked. What is parsed or decoded of it is read through the same
// descriptor: by its name another file might be found by then.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/result.h"
#include "imaging/guard/byte_source.h"
#include "imaging/guard/dicom/preflight.h"

namespace tidemark::imaging {

struct CheckedDicom {
  std::unique_ptr<FileBytes> bytes;  // stays where it is when this is moved: parsed datasets refer to it
  Preflight checked;
};

// Opens the file and checks it; what is wrong with it is in `checked`. Fails (ErrorKind::input), naming the
// file, when it cannot be read.
[[nodiscard]] Result<CheckedDicom> check_dicom(const std::filesystem::path& file);

// The same, and fails (ErrorKind::input) also when the file must not be parsed.
[[nodiscard]] Result<CheckedDicom> check_dicom_to_parse(const std::filesystem::path& file);

// Why the verdict is not good: one line without the file's name, "is damaged: ... (at byte 1234)".
[[nodiscard]] std::string describe(const Preflight& checked);

}  // namespace tidemark::imaging
