// A NIfTI file, plain or gzip.
#include <cstdlib>

#include "imaging/files/volume_file.h"
#include "tests/fuzz/scratch_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  static tidemark::fuzz::ScratchFile scratch;
  const bool is_gzip = count > 1 && bytes[0] == 0x1f && bytes[1] == 0x8b;
  const auto file = scratch.write(is_gzip ? "v.nii.gz" : "v.nii", bytes, count);
  const auto series = tidemark::imaging::scan_volume_file(file);
  const auto volume = tidemark::imaging::read_volume_file(file);
  // What can be read has been listed as such.
  if (volume && !(series && series->loadable)) std::abort();
  return 0;
}
