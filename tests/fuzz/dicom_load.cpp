// A DICOM file, as the loader takes it: preflight, DCMTK, header, pixels.
#include <cstdlib>

#include "imaging/dicom/pixels.h"
#include "tests/fuzz/scratch_file.h"

// DCMTK reads its data dictionary once, which takes longer than an input may.
extern "C" int LLVMFuzzerInitialize(int*, char***) {
  static_cast<void>(tidemark::decode_slice({}));
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  static tidemark::fuzz::ScratchFile scratch;
  const auto slice = tidemark::decode_slice(scratch.write("slice.dcm", bytes, count));
  if (slice &&
      static_cast<std::int64_t>(slice->stored.size()) != slice->header.rows * slice->header.columns) {
    std::abort();
  }
  return 0;
}
