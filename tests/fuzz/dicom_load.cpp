// A DICOM file, as the loader takes it: preflight, DCMTK, headers of its slices, pixels of its first frames.
#include <algorithm>
#include <cstdlib>
#include <vector>

#include "imaging/dicom/pixels.h"
#include "tests/fuzz/scratch_file.h"

// DCMTK reads its data dictionary once, which takes longer than an input may.
extern "C" int LLVMFuzzerInitialize(int*, char***) {
  static_cast<void>(tidemark::imaging::decode_frame({}));
  return 0;
}

// What can be decoded can be read into place. Values are not compared: of a damaged stream the decoder leaves
// some as they were.
static void check_words(const tidemark::imaging::FrameReader& image, std::int64_t frame,
                        const tidemark::imaging::FramePixels& pixels) {
  std::vector<std::uint16_t> words(pixels.stored.size());
  for (const bool is_signed : {false, true}) {
    if (image.has_words(is_signed) && !image.read_words(frame, words)) std::abort();
  }
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  static tidemark::fuzz::ScratchFile scratch;
  const auto image = tidemark::imaging::FrameReader::open(scratch.write("slice.dcm", bytes, count));
  if (!image) return 0;
  constexpr std::int64_t kFrames = 4;
  for (std::int64_t f = 0; f < std::min(kFrames, image->frames()); ++f) {
    const auto pixels = image->decode(f);
    const auto* header = image->slice(f, 0);
    if (header == nullptr) std::abort();
    const std::int64_t area = header->frame_rows * header->frame_columns;
    if (pixels && static_cast<std::int64_t>(pixels->stored.size()) != area) std::abort();
    if (pixels) check_words(*image, f, *pixels);
  }
  return 0;
}
