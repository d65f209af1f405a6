// The one check of a file that is to be sent, or has come.
#pragma once

#include <filesystem>
#include <string>

#include "core/result.h"
#include "imaging/audit/event.h"
#include "imaging/dicom/parsed_dicom.h"

namespace tidemark::imaging {

// The identity of a DICOM file, by its own attributes.
struct ObjectIdentity {
  std::string sop_class;
  std::string sop_instance;
  std::string study;   // Study Instance UID
  std::string series;  // Series Instance UID
  std::string transfer_syntax;
  AuditedStudy audited;  // this object alone

  bool operator==(const ObjectIdentity&) const = default;
};

struct CheckedObject {
  ObjectIdentity identity;
  ParsedDicom parsed;
};

// Checks that the file is sound, before DCMTK parses it, and reads its identity. Fails (ErrorKind::input)
// with what is wrong, in one line that begins with the file's name.
Result<ObjectIdentity> check_object(const std::filesystem::path& file);

// The same, with the whole object, which comes from the bytes that were checked. Fails likewise.
Result<CheckedObject> load_checked_object(const std::filesystem::path& file);

}  // namespace tidemark::imaging
