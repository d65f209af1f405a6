// The one check of a file that is to be sent, or has come.
#pragma once

#include <filesystem>
#include <string>

#include "core/result.h"

namespace tidemark {

// What a DICOM file says that it is.
struct ObjectIdentity {
  std::string sop_class;
  std::string sop_instance;
  std::string study;   // Study Instance UID
  std::string series;  // Series Instance UID
  std::string transfer_syntax;
};

// Checks that the file is sound, before DCMTK parses it, and reads its identity. Fails (ErrorKind::input)
// with what is wrong, in one line that begins with the file's name.
Result<ObjectIdentity> check_object(const std::filesystem::path& file);

}  // namespace tidemark
