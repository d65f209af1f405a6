#include "tests/imaging/dicom/directory_bytes.h"

namespace tidemark::test {

std::string directory_record(const char* type, const std::string& rest) {
  return item(number(0x00041410, 0xffff) + text(0x00041430, "CS", type) + rest);
}

std::string directory_bytes(const std::string& series_uid, const std::vector<std::string>& names) {
  std::string records = directory_record("PATIENT", "") + directory_record("STUDY", "");
  records += directory_record("SERIES", text(0x0020000e, "UI", series_uid));
  for (const std::string& name : names) {
    records += directory_record("IMAGE", text(0x00041500, "CS", name));
  }
  return file(Dataset().put(0x00041220, element(0x00041220, "SQ", records)));
}

}  // namespace tidemark::test
