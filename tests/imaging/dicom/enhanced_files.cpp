#include "tests/imaging/dicom/enhanced_files.h"

#include <dcmtk/dcmdata/dcpixel.h>
#include <dcmtk/dcmdata/dcpixseq.h>
#include <dcmtk/dcmdata/dcpxitem.h>

#include <QtGlobal>
#include <algorithm>
#include <memory>

#include "imaging/dicom/dicom_values.h"
#include "tests/imaging/dicom/recode.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/support/support.h"

namespace tidemark::test {
namespace {

void put(DcmItem& item, const DcmTagKey& key, const std::string& text) {
  if (item.putAndInsertString(DcmTag(key), text.c_str()).bad()) qFatal("cannot put %s", text.c_str());
}

std::vector<Uint16> words_of(const std::vector<EnhancedFrame>& frames) {
  std::vector<Uint16> words;
  for (const auto& [volume, k] : frames) {
    std::visit(
        [&words, size = volume->geometry.size,
         first = volume->geometry.offset({0, 0, k})](const auto& voxels) {
          const auto begin = voxels.begin() + first;
          std::transform(begin, begin + size.x * size.y, std::back_inserter(words),
                         [](auto value) { return static_cast<Uint16>(value); });
        },
        volume->voxels);
  }
  return words;
}

void put_shared(const Volume& volume, DcmDataset& dataset) {
  DcmItem& shared = group(dataset, DCM_SharedFunctionalGroupsSequence);
  const auto& d = volume.geometry.direction;
  put(group(shared, DCM_PlaneOrientationSequence), DCM_ImageOrientationPatient,
      imaging::decimals(d[0].x, d[0].y, d[0].z, d[1].x, d[1].y, d[1].z));
  put(group(shared, DCM_PixelMeasuresSequence), DCM_PixelSpacing,
      imaging::decimals(volume.geometry.spacing_mm.y, volume.geometry.spacing_mm.x));
  DcmItem& values = group(shared, DCM_PixelValueTransformationSequence);
  put(values, DCM_RescaleSlope, imaging::decimal(volume.slope));
  put(values, DCM_RescaleIntercept, imaging::decimal(volume.intercept));
}

}  // namespace

std::vector<EnhancedFrame> frames_of(const Volume& volume) {
  std::vector<EnhancedFrame> frames;
  for (std::int64_t k = 0; k < volume.geometry.size.z; ++k) frames.push_back({&volume, k});
  return frames;
}

DcmItem& group(DcmItem& groups, const DcmTagKey& sequence) {
  DcmItem* item = nullptr;
  if (groups.findOrCreateSequenceItem(DcmTag(sequence), item, 0).bad()) qFatal("cannot make a group");
  return *item;
}

void write_enhanced(const std::vector<EnhancedFrame>& frames, const std::filesystem::path& file,
                    const Enhanced& enhanced) {
  // A classic slice's attributes of patient, study, series and pixels hold for all frames.
  const TemporaryFolder scratch;
  const auto classic = write_series(*frames.front().volume, scratch / "classic", "MR").front();
  const auto make = [&](DcmDataset& dataset) {
    for (const DcmTagKey& key : {DCM_ImagePositionPatient, DCM_ImageOrientationPatient, DCM_PixelSpacing,
                                 DCM_RescaleSlope, DCM_RescaleIntercept}) {
      delete dataset.remove(key);
    }
    put(dataset, DCM_SOPClassUID, enhanced.sop_class);
    put(dataset, DCM_NumberOfFrames, std::to_string(frames.size()));
    put_shared(*frames.front().volume, dataset);
    for (std::size_t f = 0; f < frames.size(); ++f) {
      DcmItem* groups = nullptr;
      dataset.findOrCreateSequenceItem(DCM_PerFrameFunctionalGroupsSequence, groups, -2);
      const auto& [volume, k] = frames[f];
      const glm::dvec3 p = volume->geometry.to_patient({0.0, 0.0, static_cast<double>(k)});
      put(group(*groups, DCM_PlanePositionSequence), DCM_ImagePositionPatient,
          imaging::decimals(p.x, p.y, p.z));
      enhanced.frame(*groups, f);
    }
    const auto words = words_of(frames);
    dataset.putAndInsertUint16Array(DcmTag(DCM_PixelData, EVR_OW), words.data(),
                                    static_cast<unsigned long>(words.size()));
    enhanced.whole(dataset);
  };
  std::filesystem::create_directories(file.parent_path());
  edit(classic, make, file);
}

void encode_frames_j2k(DcmDataset& dataset, int pieces, bool has_table) {
  Uint16 rows = 0;
  Uint16 columns = 0;
  dataset.findAndGetUint16(DCM_Rows, rows);
  dataset.findAndGetUint16(DCM_Columns, columns);
  const Uint16* words = nullptr;
  unsigned long count = 0;
  dataset.findAndGetUint16Array(DCM_PixelData, words, &count);
  auto sequence = std::make_unique<DcmPixelSequence>(DCM_PixelSequenceTag);
  auto* table = new DcmPixelItem(DCM_PixelItemTag);
  sequence->insert(table);
  std::vector<Uint32> offsets;
  Uint32 at = 0;
  const unsigned long area = static_cast<unsigned long>(rows) * columns;
  for (unsigned long begin = 0; begin < count; begin += area) {
    const std::vector<std::int32_t> values(words + begin, words + begin + area);
    auto stream = encode_j2k(values, columns, rows, 16, false, false);
    if (stream.size() % 2 != 0) stream.push_back(0);
    offsets.push_back(at);
    const std::size_t piece = (stream.size() / static_cast<std::size_t>(pieces) + 1) / 2 * 2;
    for (std::size_t from = 0; from < stream.size(); from += piece) {
      const std::size_t length = std::min(piece, stream.size() - from);
      auto* item = new DcmPixelItem(DCM_PixelItemTag);
      item->putUint8Array(stream.data() + from, static_cast<unsigned long>(length));
      sequence->insert(item);
      at += static_cast<Uint32>(length) + 8;
    }
  }
  if (has_table) {
    // The entries are little endian, as this machine is.
    table->putUint8Array(reinterpret_cast<const Uint8*>(offsets.data()),
                         static_cast<unsigned long>(4 * offsets.size()));
  }
  auto pixels = std::make_unique<DcmPixelData>(DcmTag(DCM_PixelData, EVR_OB));
  pixels->putOriginalRepresentation(EXS_JPEG2000LosslessOnly, nullptr, sequence.release());
  dataset.insert(pixels.release(), OFTrue);
}

}  // namespace tidemark::test
