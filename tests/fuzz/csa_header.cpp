// The CSA header of a Siemens mosaic that is well otherwise: its table, and the slices that it makes.
#include "imaging/dicom/csa_header.h"

#include <cmath>
#include <cstdlib>

#include "imaging/dicom/pixels.h"
#include "tests/fuzz/scratch_file.h"
#include "tests/imaging/dicom/frame_bytes.h"

// DCMTK reads its data dictionary once, which takes longer than an input may.
extern "C" int LLVMFuzzerInitialize(int*, char***) {
  static_cast<void>(tidemark::imaging::decode_frame({}));
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  using namespace tidemark;
  static fuzz::ScratchFile scratch;
  for (const char* name : {"NumberOfImagesInMosaic", "SliceNormalVector", "SpacingBetweenSlices"}) {
    constexpr std::size_t kLeastValue = 16;  // bytes
    if (imaging::csa_numbers({bytes, count}, name).size() > count / kLeastValue) std::abort();
  }
  std::string header(reinterpret_cast<const char*>(bytes), count);
  if (header.size() % 2 != 0) header.push_back('\0');
  const std::string whole = test::file(test::mosaic(header));
  const auto image = imaging::FrameReader::open(
      scratch.write("mosaic.dcm", reinterpret_cast<const std::uint8_t*>(whole.data()), whole.size()));
  if (!image) return 0;
  const auto tiles = static_cast<std::int64_t>(image->slices().size());
  for (const imaging::SliceHeader& slice : image->slices()) {
    const glm::dvec3 place = slice.position_mm.value();
    if (!std::isfinite(place.x + place.y + place.z)) std::abort();
    if (slice.rows < 1 || slice.columns < 1 || slice.tiles != tiles) std::abort();
  }
  return 0;
}
