#include "imaging/dicom/j2k_codec.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dccodec.h>
#include <dcmtk/dcmdata/dcpxitem.h>
#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "imaging/dicom/j2k_stream.h"
#include "imaging/guard/dicom/transfer_syntaxes.h"

namespace tidemark::imaging {
namespace {

class J2kParameter : public DcmCodecParameter {
 public:
  DcmCodecParameter* clone() const override { return new J2kParameter(*this); }
  const char* className() const override { return "J2kParameter"; }
};

OFCondition failure(const std::string& why) {
  constexpr unsigned short kCode = 0x7fff;
  return makeOFCondition(OFM_dcmdata, kCode, OF_error, why.c_str());
}

// The dataset's attributes of the frame.
struct FrameFormat {
  Uint16 rows = 0;
  Uint16 columns = 0;
  Uint16 bits_allocated = 0;
  Uint16 pixel_representation = 0;
};

OFCondition read_format(DcmItem& dataset, FrameFormat& format) {
  Uint16 samples = 0;
  const bool complete =
      dataset.findAndGetUint16(DCM_Rows, format.rows).good() &&
      dataset.findAndGetUint16(DCM_Columns, format.columns).good() &&
      dataset.findAndGetUint16(DCM_BitsAllocated, format.bits_allocated).good() &&
      dataset.findAndGetUint16(DCM_PixelRepresentation, format.pixel_representation).good() &&
      dataset.findAndGetUint16(DCM_SamplesPerPixel, samples).good();
  if (!complete) return failure("the Image Pixel module is incomplete");
  Sint32 frames = 1;
  if (dataset.findAndGetSint32(DCM_NumberOfFrames, frames).bad()) frames = 1;
  if (samples != 1 || frames != 1 || (format.bits_allocated != 8 && format.bits_allocated != 16)) {
    return failure("only one frame of one component of 8 or 16 bits is decoded");
  }
  return EC_Normal;
}

// The bytes of all fragments of the frame; the first item is the offset table.
OFCondition gather(DcmPixelSequence& sequence, std::vector<std::uint8_t>& bytes) {
  for (unsigned long index = 1; index < sequence.card(); ++index) {
    DcmPixelItem* item = nullptr;
    Uint8* data = nullptr;
    if (sequence.getItem(item, index).bad() || item == nullptr || item->getUint8Array(data).bad() ||
        data == nullptr) {
      return failure("a fragment cannot be read");
    }
    bytes.insert(bytes.end(), data, data + item->getLength());
  }
  return EC_Normal;
}

// Values as 16-bit words, as DCMTK keeps pixels; 8-bit values two to a word, the first in the low byte.
OFCondition pack(const J2kImage& image, const FrameFormat& format, std::vector<Uint16>& words) {
  if (image.precision > format.bits_allocated) {
    return failure(fmt::format("the JPEG 2000 stream has {} bits a value, BitsAllocated is {}",
                               image.precision, format.bits_allocated));
  }
  // The other way round, large unsigned values are meant as negative two's complement.
  const bool below_zero = std::any_of(image.values.begin(), image.values.end(), [](auto v) { return v < 0; });
  if (below_zero && format.pixel_representation == 0) {
    return failure("the JPEG 2000 stream has negative values, PixelRepresentation says there are none");
  }
  if (format.bits_allocated == 16) {
    words.resize(image.values.size());
    std::transform(image.values.begin(), image.values.end(), words.begin(),
                   [](std::int32_t v) { return static_cast<Uint16>(v); });
    return EC_Normal;
  }
  words.assign((image.values.size() + 1) / 2, 0);
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    const auto byte = static_cast<Uint16>(image.values[i] & 0xff);
    words[i / 2] = static_cast<Uint16>(words[i / 2] | byte << (i % 2 * 8));
  }
  return EC_Normal;
}

OFCondition decode_frame(DcmItem& dataset, DcmPixelSequence& sequence, std::vector<Uint16>& words) {
  FrameFormat format;
  if (const OFCondition read = read_format(dataset, format); read.bad()) return read;
  std::vector<std::uint8_t> bytes;
  if (const OFCondition gathered = gather(sequence, bytes); gathered.bad()) return gathered;
  const auto image = decode_j2k(bytes, format.columns, format.rows);
  if (!image) return failure(image.error().message);
  return pack(*image, format, words);
}

// Newer releases of DCMTK (not yet 3.6.7) ask every codec for the bits that decoded values take. In a class
// of its own, since whether it overrides anything depends on the release.
class CodecWithBits : public DcmCodec {
 public:
  // NOLINTNEXTLINE(modernize-use-override, readability-identifier-naming)
  virtual Uint16 decodedBitsAllocated(Uint16 bits_allocated, Uint16 /*bits_stored*/) const {
    return bits_allocated == 8 || bits_allocated == 16 ? bits_allocated : 0;
  }
};

class J2kDecoder : public CodecWithBits {
 public:
  OFCondition decode(const DcmRepresentationParameter*, DcmPixelSequence* sequence,
                     DcmPolymorphOBOW& uncompressed, const DcmCodecParameter*, const DcmStack& stack,
                     OFBool& remove_old) const override {
    remove_old = OFFalse;
    // The pixel data is on top, the dataset below it.
    auto* dataset = stack.card() >= 2 ? dynamic_cast<DcmItem*>(stack.elem(1)) : nullptr;
    if (dataset == nullptr || sequence == nullptr) return EC_IllegalCall;
    std::vector<Uint16> words;
    if (const OFCondition decoded = decode_frame(*dataset, *sequence, words); decoded.bad()) return decoded;
    return uncompressed.putUint16Array(words.data(), static_cast<unsigned long>(words.size()));
  }

  OFCondition decodeFrame(const DcmRepresentationParameter*, DcmPixelSequence* sequence,
                          const DcmCodecParameter*, DcmItem* dataset, Uint32 frame, Uint32& start_fragment,
                          void* buffer, Uint32 size, OFString& colours) const override {
    if (dataset == nullptr || sequence == nullptr || frame != 0) return EC_IllegalCall;
    std::vector<Uint16> words;
    if (const OFCondition decoded = decode_frame(*dataset, *sequence, words); decoded.bad()) return decoded;
    if (words.size() * sizeof(Uint16) > size) return EC_IllegalCall;
    std::copy(words.begin(), words.end(), static_cast<Uint16*>(buffer));
    start_fragment = static_cast<Uint32>(sequence->card());
    return dataset->findAndGetOFString(DCM_PhotometricInterpretation, colours);
  }

  OFCondition encode(const Uint16*, const Uint32, const DcmRepresentationParameter*, DcmPixelSequence*&,
                     const DcmCodecParameter*, DcmStack&, OFBool&) const override {
    return EC_IllegalCall;
  }

  OFCondition encode(const E_TransferSyntax, const DcmRepresentationParameter*, DcmPixelSequence*,
                     const DcmRepresentationParameter*, DcmPixelSequence*&, const DcmCodecParameter*,
                     DcmStack&, OFBool&) const override {
    return EC_IllegalCall;
  }

  OFBool canChangeCoding(const E_TransferSyntax from, const E_TransferSyntax to) const override {
    const bool from_j2k = from == EXS_JPEG2000 || from == EXS_JPEG2000LosslessOnly;
    const TransferSyntax* syntax = find_transfer_syntax(DcmXfer(to).getXferID());
    return from_j2k && syntax != nullptr && !syntax->is_encapsulated();
  }

  OFCondition determineDecompressedColorModel(const DcmRepresentationParameter*, DcmPixelSequence*,
                                              const DcmCodecParameter*, DcmItem* dataset,
                                              OFString& colours) const override {
    if (dataset == nullptr) return EC_IllegalCall;
    return dataset->findAndGetOFString(DCM_PhotometricInterpretation, colours);
  }
};

}  // namespace

void register_j2k_decoder() {
  // DCMTK keeps pointers to both for as long as it lives.
  static const J2kDecoder decoder;
  static const J2kParameter parameter;
  DcmCodecList::registerCodec(&decoder, nullptr, &parameter);
}

}  // namespace tidemark::imaging
