// The walk over a DICOM file's tags, on bytes in memory.
#include <cstdlib>

#include "imaging/guard/dicom/preflight.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  using tidemark::imaging::Preflight;
  tidemark::imaging::MemoryBytes source({bytes, count});
  const tidemark::imaging::Preflight checked = tidemark::imaging::preflight_dicom(source);
  // A file to be parsed has a syntax; a refused one has a reason.
  if (checked.may_be_parsed() && checked.syntax == nullptr) std::abort();
  if ((checked.verdict == tidemark::imaging::Preflight::Verdict::good) != checked.reason.what.empty())
    std::abort();
  return 0;
}
