// A DICOMDIR on a medium that has one image, IMAGES/IM1.
#include "imaging/dicom/media_directory.h"

#include <algorithm>
#include <cstdlib>

#include "imaging/dicom/pixels.h"
#include "tests/fuzz/scratch_file.h"

// DCMTK reads its data dictionary once, which takes longer than an input may.
extern "C" int LLVMFuzzerInitialize(int*, char***) {
  static_cast<void>(tidemark::imaging::decode_frame({}));
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  static tidemark::fuzz::ScratchFile scratch;
  static const auto image = scratch.write("IMAGES/IM1", nullptr, 0);
  const auto file = scratch.write("DICOMDIR", bytes, count);
  const auto directory = tidemark::imaging::read_media_directory(file);
  if (!directory) return 0;
  // Nothing else is there, and what is there is named once.
  const auto& files = directory->files;
  const auto named = [&](const auto& one) { return std::count(files.begin(), files.end(), one); };
  if (named(image) > 1 || named(file) > 1) std::abort();
  if (static_cast<std::size_t>(named(image) + named(file)) != files.size()) std::abort();
  // Names come into messages of one line.
  const std::string text = tidemark::imaging::list_missing(directory->missing);
  const auto is_printable = [](char c) { return c >= 0x20 && c <= 0x7e; };
  if (text.size() > 400 || !std::all_of(text.begin(), text.end(), is_printable)) std::abort();
  return 0;
}
