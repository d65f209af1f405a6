#include "imaging/dicom/frame_codec.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcpixel.h>
#include <dcmtk/dcmdata/dcpixseq.h>
#include <dcmtk/dcmdata/dcpxitem.h>
#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>
#include <memory>

namespace tidemark::imaging {
namespace {

using FragmentBytes = std::vector<std::vector<std::uint8_t>>;

// The Image Pixel module as a codec asks for it: the frame is an image of its own.
void put_format(const SliceHeader& header, DcmDataset& dataset) {
  const auto put = [&](const DcmTagKey& key, std::int64_t value) {
    dataset.putAndInsertUint16(DcmTag(key), static_cast<Uint16>(value));
  };
  put(DCM_SamplesPerPixel, 1);
  dataset.putAndInsertString(DCM_PhotometricInterpretation,
                             header.is_monochrome1 ? "MONOCHROME1" : "MONOCHROME2");
  put(DCM_Rows, header.frame_rows);
  put(DCM_Columns, header.frame_columns);
  put(DCM_BitsAllocated, header.bits_allocated);
  put(DCM_BitsStored, header.bits_stored);
  put(DCM_HighBit, header.high_bit);
  put(DCM_PixelRepresentation, header.is_signed ? 1 : 0);
}

OFCondition put_fragments(const FragmentBytes& fragments, E_TransferSyntax syntax, DcmDataset& dataset) {
  auto sequence = std::make_unique<DcmPixelSequence>(DCM_PixelSequenceTag);
  OFCondition put = sequence->insert(new DcmPixelItem(DCM_PixelItemTag));  // the offset table
  for (const auto& fragment : fragments) {
    auto item = std::make_unique<DcmPixelItem>(DCM_PixelItemTag);
    if (put.good()) put = item->putUint8Array(fragment.data(), static_cast<unsigned long>(fragment.size()));
    if (put.good()) put = sequence->insert(item.release());
  }
  auto pixels = std::make_unique<DcmPixelData>(DcmTag(DCM_PixelData, EVR_OB));
  pixels->putOriginalRepresentation(syntax, nullptr, sequence.release());
  if (put.good()) put = dataset.insert(pixels.release(), OFTrue);
  return put;
}

OFCondition take_words(DcmElement& element, int bits, std::vector<std::uint32_t>& words) {
  if (bits == 8) {
    Uint8* bytes = nullptr;
    if (const OFCondition got = element.getUint8Array(bytes); got.bad()) return got;
    if (bytes == nullptr) return EC_CorruptedData;
    for (std::size_t p = 0; p < words.size(); ++p) words[p] = bytes[p];
    return EC_Normal;
  }
  Uint16* halves = nullptr;
  if (const OFCondition got = element.getUint16Array(halves); got.bad()) return got;
  if (halves == nullptr) return EC_CorruptedData;
  for (std::size_t p = 0; p < words.size(); ++p) {
    words[p] = bits == 16 ? halves[p] : halves[2 * p] | std::uint32_t{halves[2 * p + 1]} << 16;
  }
  return EC_Normal;
}

// The decoded frame, which the dataset keeps.
tl::expected<DcmElement*, std::string> decode_within(DcmDataset& dataset, const FragmentBytes& fragments,
                                                     const TransferSyntax& syntax,
                                                     const SliceHeader& header) {
  const DcmXfer coded(std::string(syntax.uid).c_str());
  put_format(header, dataset);
  OFCondition decoded = put_fragments(fragments, coded.getXfer(), dataset);
  if (decoded.good()) decoded = dataset.chooseRepresentation(EXS_LittleEndianExplicit, nullptr);
  DcmElement* element = nullptr;
  if (decoded.good()) decoded = dataset.findAndGetElement(DCM_PixelData, element);
  if (decoded.bad()) {
    return tl::unexpected(fmt::format("cannot be decoded ({}): {}", syntax.name, decoded.text()));
  }
  const std::int64_t bytes = header.frame_rows * header.frame_columns * header.bits_allocated / 8;
  const std::int64_t held = element->getLength();
  if (held != bytes && held != bytes + bytes % 2) {
    return tl::unexpected(fmt::format("decodes to {} bytes where {} x {} pixels need {}", held,
                                      header.frame_columns, header.frame_rows, bytes));
  }
  return element;
}

std::string unreadable(const OFCondition& taken) {
  return fmt::format("cannot be read: {}", taken.text());
}

}  // namespace

tl::expected<std::vector<std::uint32_t>, std::string> decode_fragments(const FragmentBytes& fragments,
                                                                       const TransferSyntax& syntax,
                                                                       const SliceHeader& header) {
  DcmDataset dataset;
  const auto element = decode_within(dataset, fragments, syntax, header);
  if (!element) return tl::unexpected(element.error());
  std::vector<std::uint32_t> words(static_cast<std::size_t>(header.frame_rows * header.frame_columns));
  if (const OFCondition taken = take_words(**element, header.bits_allocated, words); taken.bad()) {
    return tl::unexpected(unreadable(taken));
  }
  return words;
}

std::string decode_words(const FragmentBytes& fragments, const TransferSyntax& syntax,
                         const SliceHeader& header, std::span<std::uint16_t> target) {
  DcmDataset dataset;
  const auto element = decode_within(dataset, fragments, syntax, header);
  if (!element) return element.error();
  Uint16* words = nullptr;
  if (const OFCondition taken = (*element)->getUint16Array(words); taken.bad()) return unreadable(taken);
  if (words == nullptr) return unreadable(EC_CorruptedData);
  std::copy(words, words + target.size(), target.begin());
  return {};
}

}  // namespace tidemark::imaging
