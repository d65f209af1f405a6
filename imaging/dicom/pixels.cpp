#include "imaging/dicom/pixels.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>
#include <limits>

#include "core/checked.h"
#include "imaging/dicom/dicom_setup.h"
#include "imaging/dicom/header_reader.h"

namespace tidemark {
namespace {

namespace fs = std::filesystem;

// Takes the stored bits out of words and extends their sign.
class BitReader {
 public:
  explicit BitReader(const SliceHeader& header)
      : shift_(header.high_bit + 1 - header.bits_stored),
        mask_(static_cast<std::uint32_t>((std::uint64_t{1} << header.bits_stored) - 1)),
        sign_(header.is_signed ? std::uint32_t{1} << (header.bits_stored - 1) : 0),
        word_mask_(static_cast<std::uint32_t>((std::uint64_t{1} << header.bits_allocated) - 1)) {}

  // Unsigned values of 32 bits stay in their low 32 bits; the caller looks at them. Without branches, so that
  // several pixels are done at once.
  std::int32_t operator()(std::uint32_t word) {
    const std::uint32_t bits = word >> shift_ & mask_;
    const std::uint32_t value = (bits ^ sign_) - sign_;  // extends the sign
    // A sign extended over the word is as good as clean.
    const std::uint32_t clean = bits << shift_;
    const std::uint32_t extended = value << shift_ & word_mask_;
    ignored_ |= static_cast<std::uint32_t>(word != clean) & static_cast<std::uint32_t>(word != extended);
    return static_cast<std::int32_t>(value);
  }
  [[nodiscard]] bool ignored() const { return ignored_ != 0; }

 private:
  int shift_;
  std::uint32_t mask_;
  std::uint32_t sign_;
  std::uint32_t word_mask_;
  std::uint32_t ignored_ = 0;
};

// 32-bit pixels as DCMTK keeps them: 16-bit words, each in the machine's order, in the file's order.
std::uint32_t join(const Uint16* words, std::size_t pixel, bool high_word_first) {
  const std::uint32_t a = words[2 * pixel];
  const std::uint32_t b = words[2 * pixel + 1];
  return high_word_first ? a << 16 | b : b << 16 | a;
}

OFCondition read_words(DcmElement& element, bool high_word_first, SlicePixels& slice) {
  BitReader read(slice.header);
  auto& stored = slice.stored;
  if (slice.header.bits_allocated == 8) {
    Uint8* bytes = nullptr;
    if (const OFCondition got = element.getUint8Array(bytes); got.bad()) return got;
    if (bytes == nullptr) return EC_CorruptedData;
    for (std::size_t p = 0; p < stored.size(); ++p) stored[p] = read(bytes[p]);
  } else {
    Uint16* words = nullptr;
    if (const OFCondition got = element.getUint16Array(words); got.bad()) return got;
    if (words == nullptr) return EC_CorruptedData;
    if (slice.header.bits_allocated == 32) {
      for (std::size_t p = 0; p < stored.size(); ++p) stored[p] = read(join(words, p, high_word_first));
    } else {
      for (std::size_t p = 0; p < stored.size(); ++p) stored[p] = read(words[p]);
    }
  }
  slice.ignored_bits = read.ignored();
  return EC_Normal;
}

Result<SlicePixels> decode(const fs::path& file) {
  auto opened = open_slice(file);
  if (!opened) return pass_on(opened);
  SliceHeader& header = opened->header;
  if (!header.problem.empty()) return fail(ErrorKind::input, "{}: {}", file.string(), header.problem);

  DcmDataset& dataset = *opened->loaded->getDataset();
  const DcmXfer original(dataset.getOriginalXfer());
  if (original.isEncapsulated()) {
    const OFCondition decoded = dataset.chooseRepresentation(EXS_LittleEndianExplicit, nullptr);
    if (decoded.bad()) {
      return fail(ErrorKind::input, "{}: PixelData (7FE0,0010) cannot be decoded ({}): {}", file.string(),
                  original.getXferName(), decoded.text());
    }
  }
  DcmElement* element = nullptr;
  if (dataset.findAndGetElement(DCM_PixelData, element).bad() || element == nullptr) {
    return fail(ErrorKind::input, "{}: PixelData (7FE0,0010) is missing", file.string());
  }
  const auto pixels = checked_product(header.rows, header.columns);
  const auto bytes = checked_product(header.rows, header.columns, header.bits_allocated / 8);
  const std::int64_t held = element->getLength();
  if (!pixels || !bytes || (held != *bytes && held != *bytes + *bytes % 2)) {
    return fail(ErrorKind::input,
                "{}: PixelData (7FE0,0010) decodes to {} bytes where {} x {} pixels need {}", file.string(),
                held, header.columns, header.rows, bytes.value_or(0));
  }
  SlicePixels slice{std::move(header), std::vector<std::int32_t>(static_cast<std::size_t>(*pixels)), false};
  const bool high_word_first = original.getXfer() == EXS_BigEndianExplicit;
  if (const OFCondition read = read_words(*element, high_word_first, slice); read.bad()) {
    return fail(ErrorKind::input, "{}: PixelData (7FE0,0010) cannot be read: {}", file.string(), read.text());
  }
  const bool may_wrap = slice.header.bits_stored == 32 && !slice.header.is_signed;
  if (may_wrap && *std::min_element(slice.stored.begin(), slice.stored.end()) < 0) {
    return fail(ErrorKind::input, "{}: PixelData (7FE0,0010) holds values above {}", file.string(),
                std::numeric_limits<std::int32_t>::max());
  }
  return slice;
}

}  // namespace

Result<SlicePixels> decode_slice(const fs::path& file) {
  try {
    if (auto ready = set_up_dicom(); !ready) return pass_on(ready);
    return decode(file);
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::capability, "{}: there is not enough memory", file.string());
  } catch (const std::exception& error) {
    return fail(ErrorKind::input, "{}: cannot be read: {}", file.string(), error.what());
  }
}

}  // namespace tidemark
