#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmfg/fgderimg.h>
#include <dcmtk/dcmfg/fgfracon.h>
#include <dcmtk/dcmfg/fgpixmsr.h>
#include <dcmtk/dcmfg/fgplanor.h>
#include <dcmtk/dcmfg/fgplanpo.h>
#include <dcmtk/dcmiod/cielabutil.h>
#include <dcmtk/dcmiod/iodreferences.h>
#include <dcmtk/dcmseg/segdoc.h>
#include <dcmtk/dcmseg/segment.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "imaging/dicom/dicom_values.h"
#include "imaging/guard/guarded.h"
#include "imaging/results/results.h"
#include "imaging/results/source_study.h"

namespace tidemark::imaging {
namespace {

namespace fs = std::filesystem;

CodeSequenceMacro code_macro(const Code& code) {
  return {text_of(code.value), text_of(code.scheme), text_of(code.meaning)};
}

// One writing of one file.
class SegmentationWriter {
 public:
  SegmentationWriter(const Segments& segments, const SourceStudy& study, const fs::path& file)
      : segments_(segments), geometry_(segments.geometry), study_(study), file_(file) {}

  Status write(const Progress& progress);

 private:
  Status create();
  void identify();
  void describe_planes();
  void refer_to_source();
  Status add_segment(const Segment& segment);
  Status add_frame(std::uint16_t number, std::int64_t k, std::vector<std::uint8_t>& slice);
  Status add_frames(const Progress& progress);
  void put_names(DcmDataset& dataset);
  void put_loss(DcmDataset& dataset);
  void put_pixels(DcmDataset& dataset);

  const Segments& segments_;
  const Geometry& geometry_;
  const SourceStudy& study_;
  const fs::path& file_;
  std::unique_ptr<DcmSegmentation> document_;
  std::map<std::int64_t, std::uint32_t>
      position_;  // slice k: which of the slices that are written it is, from 1
  FirstFailure failure_;
};

Status SegmentationWriter::create() {
  const IODGeneralEquipmentModule::EquipmentInfo equipment("Tidemark", "Tidemark", "0", TIDEMARK_VERSION);
  ContentIdentificationMacro content("1", "SEGMENTATION", "Tidemark segmentation", "");
  DcmSegmentation* document = nullptr;
  failure_ << DcmSegmentation::createBinarySegmentation(document, static_cast<Uint16>(geometry_.size.y),
                                                        static_cast<Uint16>(geometry_.size.x), equipment,
                                                        content);
  document_.reset(document);
  return failure_.status(file_);
}

// Patient, study and frame of reference are the source's, the series is a new one.
void SegmentationWriter::identify() {
  const Timestamp now = Timestamp::now();
  failure_ << document_->importFromSourceImage(study_.attributes());
  failure_ << document_->getFrameOfReference().setFrameOfReferenceUID(text_of(study_.frame_of_reference_uid));
  failure_ << document_->getSOPCommon().setSOPInstanceUID(text_of(make_uid()));
  failure_ << document_->getSeries().setSeriesInstanceUID(text_of(make_uid()));
  failure_ << document_->getSeries().setSeriesNumber("1000");
  failure_ << document_->getSeries().setSeriesDescription("Tidemark segmentation");
  failure_ << document_->getSeries().setSeriesDate(text_of(now.date));
  failure_ << document_->getSeries().setSeriesTime(text_of(now.time));
  const OFString dimensions = text_of(make_uid());
  IODMultiframeDimensionModule& module = document_->getDimensions();
  failure_ << module.addDimensionIndex(DCM_ReferencedSegmentNumber, dimensions,
                                       DCM_SegmentIdentificationSequence, "Segment");
  failure_ << module.addDimensionIndex(DCM_ImagePositionPatient, dimensions, DCM_PlanePositionSequence,
                                       "Slice");
}

// What all frames have in common.
void SegmentationWriter::describe_planes() {
  const glm::dvec3 row = geometry_.direction[0];
  const glm::dvec3 column = geometry_.direction[1];
  FGPlaneOrientationPatient orientation;
  failure_ << orientation.setImageOrientationPatient(text_of(decimal(row.x)), text_of(decimal(row.y)),
                                                     text_of(decimal(row.z)), text_of(decimal(column.x)),
                                                     text_of(decimal(column.y)), text_of(decimal(column.z)));
  FGPixelMeasures measures;
  const glm::dvec3 spacing = geometry_.spacing_mm;
  failure_ << measures.setPixelSpacing(text_of(decimals(spacing.y, spacing.x)));  // between rows first
  failure_ << measures.setSliceThickness(text_of(decimal(spacing.z)));
  failure_ << measures.setSpacingBetweenSlices(text_of(decimal(spacing.z)));
  failure_ << document_->addForAllFrames(orientation) << document_->addForAllFrames(measures);
}

void SegmentationWriter::refer_to_source() {
  if (study_.images.empty()) return;
  IODReferences references;
  for (const SourceImage& image : study_.images) {
    references.add(new IODImageReference("", text_of(study_.study_uid), text_of(study_.series_uid),
                                         text_of(image.sop_instance_uid), text_of(image.sop_class_uid)));
  }
  document_->getCommonInstanceReference().addReferences(references, text_of(study_.study_uid));
}

Status SegmentationWriter::add_segment(const Segment& segment) {
  DcmSegment* made = nullptr;
  failure_ << DcmSegment::create(made, "Segment", code_macro(segment.meaning.category),
                                 code_macro(segment.meaning.type), DcmSegTypes::SAT_SEMIAUTOMATIC,
                                 "Tidemark level set");
  TIDEMARK_TRY(failure_.status(file_));
  const auto [red, green, blue] = segment.colour.value_or(kDefaultColour);
  double l = 0.0;
  double a = 0.0;
  double b = 0.0;
  IODCIELabUtil::rgb2DicomLab(l, a, b, red / 255.0, green / 255.0, blue / 255.0);
  const auto word = [](double value) {
    return static_cast<Uint16>(std::lround(std::clamp(value, 0.0, 65535.0)));
  };
  failure_ << made->setRecommendedDisplayCIELabValue(word(l), word(a), word(b));
  Uint16 number = 0;
  const OFCondition added = document_->addSegment(made, number);
  if (added.bad()) delete made;
  failure_ << added;
  return failure_.status(file_);
}

Status SegmentationWriter::add_frame(std::uint16_t number, std::int64_t k, std::vector<std::uint8_t>& slice) {
  const glm::dvec3 corner = geometry_.to_patient({0.0, 0.0, static_cast<double>(k)});
  FGPlanePosPatient position;
  failure_ << position.setImagePositionPatient(text_of(decimal(corner.x)), text_of(decimal(corner.y)),
                                               text_of(decimal(corner.z)));
  FGFrameContent content;
  failure_ << content.setStackID("1") << content.setInStackPositionNumber(position_.at(k));
  failure_ << content.setDimensionIndexValues(number, 0)
           << content.setDimensionIndexValues(position_.at(k), 1);
  OFVector<FGBase*> groups;
  groups.push_back(&position);
  groups.push_back(&content);
  std::unique_ptr<FGDerivationImage> derivation;
  if (const auto& place = study_.places[static_cast<std::size_t>(k)]) {
    const SourceImage& image = study_.images[place->image];
    ImageSOPInstanceReferenceMacro reference;
    failure_ << reference.setReferencedSOPClassUID(text_of(image.sop_class_uid));
    failure_ << reference.setReferencedSOPInstanceUID(text_of(image.sop_instance_uid));
    for (const std::uint16_t frame : place->frames) {
      failure_ << reference.addReferencedFrameNumber(frame);
    }
    OFVector<ImageSOPInstanceReferenceMacro> images;
    images.push_back(reference);
    derivation.reset(DcmSegmentation::createDerivationImageFG(images, ""));
    if (derivation) groups.push_back(derivation.get());
  }
  failure_ << document_->addFrame(slice.data(), number, groups);
  return failure_.status(file_);
}

// Frames by segment, then by slice.
Status SegmentationWriter::add_frames(const Progress& progress) {
  std::set<std::int64_t> written;
  for (const Segment& segment : segments_.list) {
    for (const auto& [k, slice] : segment.slices) written.insert(k);
  }
  // A file needs a frame; one of nothing says that nothing was found.
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(geometry_.size.x * geometry_.size.y));
  if (written.empty()) {
    position_[0] = 1;
    return add_frame(1, 0, pixels);
  }
  for (const std::int64_t k : written) position_.emplace(k, static_cast<std::uint32_t>(position_.size() + 1));
  std::uint16_t number = 0;
  for (const Segment& segment : segments_.list) {
    progress(static_cast<double>(number) / static_cast<double>(segments_.list.size()), "writing segments");
    ++number;
    for (const auto& [k, slice] : segment.slices) {
      if (progress.cancelled()) return cancelled_error();
      pixels = slice;  // DCMTK asks for memory that it may write to
      TIDEMARK_TRY(add_frame(number, k, pixels));
    }
  }
  return {};
}

// Into the written dataset, because DCMTK's segments take no letters beyond ASCII.
void SegmentationWriter::put_names(DcmDataset& dataset) {
  for (std::size_t n = 0; n < segments_.list.size(); ++n) {
    DcmItem* segment = nullptr;
    failure_ << dataset.findAndGetSequenceItem(DCM_SegmentSequence, segment, static_cast<signed long>(n));
    const std::string& name = segments_.list[n].name;
    if (segment != nullptr && !name.empty()) {
      failure_ << segment->putAndInsertString(DCM_SegmentLabel, short_text(name).c_str());
    }
  }
}

// Into the written dataset, because DCMTK takes no loss of unknown ratio or method, which old images may
// have.
void SegmentationWriter::put_loss(DcmDataset& dataset) {
  if (!study_.loss) return;
  const auto put = [&](const DcmTagKey& key, const std::string& value) {
    if (!value.empty()) failure_ << dataset.putAndInsertString(DcmTag(key), value.c_str());
  };
  put(DCM_LossyImageCompression, "01");
  put(DCM_LossyImageCompressionRatio, study_.loss->ratio);
  put(DCM_LossyImageCompressionMethod, study_.loss->method);
}

// Over what DCMTK 3.6.7 writes, which mixes up bits where frames do not end at whole bytes: all pixels one
// after another, the first in the lowest bit (PS3.5 8.2).
void SegmentationWriter::put_pixels(DcmDataset& dataset) {
  const auto area = static_cast<std::size_t>(geometry_.size.x * geometry_.size.y);
  const std::size_t frames = std::max<std::size_t>(document_->getNumberOfFrames(), 1);
  std::vector<Uint8> bytes((frames * area + 15) / 16 * 2);  // an even number
  std::size_t bit = 0;
  for (const Segment& segment : segments_.list) {
    for (const auto& [k, slice] : segment.slices) {
      for (const std::uint8_t inside : slice) {
        bytes[bit / 8] |= static_cast<Uint8>((inside != 0 ? 1U : 0U) << bit % 8);
        ++bit;
      }
    }
  }
  failure_ << dataset.putAndInsertUint8Array(DcmTag(DCM_PixelData, EVR_OB), bytes.data(),
                                             static_cast<unsigned long>(bytes.size()));
}

Status SegmentationWriter::write(const Progress& progress) {
  TIDEMARK_TRY(create());
  identify();
  describe_planes();
  refer_to_source();
  for (const Segment& segment : segments_.list) {
    TIDEMARK_TRY(add_segment(segment));
  }
  TIDEMARK_TRY(add_frames(progress));
  // A dataset that was just made need not be checked again frame by frame.
  document_->setCheckFGOnWrite(OFFalse);
  document_->setCheckDimensionsOnWrite(OFFalse);
  auto dataset = std::make_unique<DcmDataset>();
  failure_ << document_->writeDataset(*dataset);
  put_names(*dataset);
  put_loss(*dataset);
  put_pixels(*dataset);
  TIDEMARK_TRY(failure_.status(file_));
  document_.reset();
  return save_object(std::move(dataset), EXS_LittleEndianExplicit, file_);
}

}  // namespace

Status write_segmentation(const Segments& segments, SourceFiles source, const fs::path& file,
                          const Progress& progress) {
  return guarded_writing(file, [&]() -> Status {
    TIDEMARK_TRY(require_planes(segments.geometry, file));
    if (segments.list.empty() || segments.list.size() > 65535) {
      return fail(ErrorKind::write, "{}: cannot write a segmentation of {} segments", file.string(),
                  segments.list.size());
    }
    const auto study = source_study(source, segments.geometry);
    if (!study) return pass_on(study);
    return SegmentationWriter(segments, *study, file).write(progress);
  });
}

}  // namespace tidemark::imaging
