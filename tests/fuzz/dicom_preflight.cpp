// The walk over a DICOM file's tags, on bytes in memory.
#include <cstdlib>

#include "imaging/dicom/preflight.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  using tidemark::Preflight;
  tidemark::MemoryBytes source({bytes, count});
  const Preflight checked = tidemark::preflight_dicom(source);
  // A file to be parsed has a syntax; a refused one has a reason.
  if (checked.may_be_parsed() && checked.syntax == nullptr) std::abort();
  if ((checked.verdict == Preflight::Verdict::good) != checked.reason.what.empty()) std::abort();
  return 0;
}
