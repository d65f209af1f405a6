// A compressed frame in a DICOM file that is well otherwise: the first byte chooses the transfer syntax and
// the bits, the next two say columns and rows, the others are the frame.
#include <array>
#include <cstdlib>

#include "imaging/dicom/pixels.h"
#include "tests/fuzz/scratch_file.h"
#include "tests/imaging/dicom/dicom_bytes.h"

// DCMTK reads its data dictionary once, which takes longer than an input may.
extern "C" int LLVMFuzzerInitialize(int*, char***) {
  static_cast<void>(tidemark::imaging::decode_frame({}));
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  using namespace tidemark::test;
  constexpr std::array kSyntaxes{"1.2.840.10008.1.2.5",    "1.2.840.10008.1.2.4.50", "1.2.840.10008.1.2.4.51",
                                 "1.2.840.10008.1.2.4.57", "1.2.840.10008.1.2.4.70", "1.2.840.10008.1.2.4.80",
                                 "1.2.840.10008.1.2.4.81", "1.2.840.10008.1.2.4.90"};
  if (count < 3) return 0;
  static tidemark::fuzz::ScratchFile scratch;
  const std::uint32_t bits = (bytes[0] & 0x80) != 0 ? 8 : 16;
  std::string frame(reinterpret_cast<const char*>(bytes) + 3, count - 3);
  if (frame.size() % 2 != 0) frame.push_back('\0');
  Dataset dataset = Dataset::slice();
  dataset.put_number(0x00280010, bytes[2]).put_number(0x00280011, bytes[1]);
  dataset.put_number(0x00280100, bits).put_number(0x00280101, bits).put_number(0x00280102, bits - 1);
  dataset.put(kPixels, encapsulated(frame));
  const std::string whole = file(kSyntaxes[bytes[0] % kSyntaxes.size()], dataset.bytes());
  const auto slice = tidemark::imaging::decode_frame(
      scratch.write("slice.dcm", reinterpret_cast<const std::uint8_t*>(whole.data()), whole.size()));
  if (slice && slice->pixels.stored.size() != std::size_t{bytes[1]} * bytes[2]) std::abort();
  return 0;
}
