// A NRRD, MetaImage or GIPL file, or a picture; the first bytes say which.
#include <cstdlib>
#include <string_view>

#include "imaging/files/volume_file.h"
#include "tests/fuzz/scratch_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  static tidemark::fuzz::ScratchFile scratch;
  const std::string_view text(reinterpret_cast<const char*>(bytes), count);
  const char* const name = text.starts_with("NRRD")                           ? "v.nrrd"
                           : text.starts_with("\x1f\x8b")                     ? "v.gipl.gz"
                           : text.starts_with("\x89PNG")                      ? "v.png"
                           : text.starts_with("\xff\xd8")                     ? "v.jpg"
                           : text.starts_with("II") || text.starts_with("MM") ? "v.tif"
                           : text.find('=') < std::size_t{64}                 ? "v.mha"
                                                                              : "v.gipl";
  const auto file = scratch.write(name, bytes, count);
  const auto series = tidemark::imaging::scan_volume_file(file);
  const auto volume = tidemark::imaging::read_volume_file(file);
  if (volume && !(series && series->loadable)) std::abort();
  return 0;
}
