#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmrt/drtstrct.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "imaging/dicom/dicom_values.h"
#include "imaging/guard/guarded.h"
#include "imaging/results/contours.h"
#include "imaging/results/results.h"
#include "imaging/results/source_study.h"

namespace tidemark::imaging {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDetachedStudy =
    "1.2.840.10008.3.1.2.3.1";  // the class by which studies are referred to

// Decimals that keep a coordinate within a thousandth of the smallest spacing.
int digits_for(const Geometry& geometry) {
  const glm::dvec3 h = geometry.spacing_mm;
  return std::clamp(static_cast<int>(std::ceil(3.0 - std::log10(std::min({h.x, h.y, h.z})))), 2, 9);
}

// At most 16 characters, without zeros at the end.
std::string coordinate(double mm, int digits) {
  std::string text = fmt::format("{:.{}f}", mm, digits);
  if (text.size() > 16) return decimal(mm);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

// One writing of one file.
class StructureSetWriter {
 public:
  StructureSetWriter(const Segments& segments, const SourceStudy& study, const fs::path& file)
      : segments_(segments),
        geometry_(segments.geometry),
        study_(study),
        file_(file),
        digits_(digits_for(segments.geometry)) {}

  Status write(const Progress& progress);

 private:
  void identify();
  void refer_to_source();
  Status describe(const Segment& segment, const std::string& number);
  Status add_contours(const Segment& segment, const std::string& number, const Progress& progress);
  Status add_contour(DRTContourSequence& sequence, const Contour& contour, std::int64_t k);
  template <class Sequence>
  Status add(Sequence& sequence, typename Sequence::Item*& item) {
    const OFCondition added = sequence.addItem(item);
    failure_ << added;
    return failure_.status(file_);
  }

  const Segments& segments_;
  const Geometry& geometry_;
  const SourceStudy& study_;
  const fs::path& file_;
  int digits_;
  DRTStructureSetIOD set_;
  FirstFailure failure_;
};

// The patient and the study are the source's, the series is a new one.
void StructureSetWriter::identify() {
  const Timestamp now = Timestamp::now();
  failure_ << set_.setSpecificCharacterSet("ISO_IR 192");
  copy_patient_and_study(study_.attributes(), set_, failure_);
  failure_ << set_.setStudyInstanceUID(text_of(study_.study_uid), OFFalse);

  failure_ << set_.setSOPInstanceUID(text_of(make_uid())) << set_.setSeriesInstanceUID(text_of(make_uid()));
  failure_ << set_.setModality("RTSTRUCT") << set_.setSeriesNumber("1001");
  failure_ << set_.setSeriesDescription("Tidemark structure set");
  failure_ << set_.setSeriesDate(text_of(now.date)) << set_.setSeriesTime(text_of(now.time));
  failure_ << set_.setManufacturer("Tidemark") << set_.setManufacturerModelName("Tidemark");
  failure_ << set_.setSoftwareVersions(TIDEMARK_VERSION);
  failure_ << set_.setStructureSetLabel("SEGMENTATION");
  failure_ << set_.setStructureSetDate(text_of(now.date)) << set_.setStructureSetTime(text_of(now.time));
  failure_ << set_.setFrameOfReferenceUID(text_of(study_.frame_of_reference_uid));
  failure_ << set_.setApprovalStatus("UNAPPROVED");
}

// The frame of reference, and in it the study, the series and its images.
void StructureSetWriter::refer_to_source() {
  DRTReferencedFrameOfReferenceSequence::Item* frame = nullptr;
  if (!add(set_.getReferencedFrameOfReferenceSequence(), frame)) return;
  failure_ << frame->setFrameOfReferenceUID(text_of(study_.frame_of_reference_uid));
  if (study_.images.empty()) return;
  DRTRTReferencedStudySequence::Item* study = nullptr;
  if (!add(frame->getRTReferencedStudySequence(), study)) return;
  failure_ << study->setReferencedSOPClassUID(kDetachedStudy);
  failure_ << study->setReferencedSOPInstanceUID(text_of(study_.study_uid));
  DRTRTReferencedSeriesSequence::Item* series = nullptr;
  if (!add(study->getRTReferencedSeriesSequence(), series)) return;
  failure_ << series->setSeriesInstanceUID(text_of(study_.series_uid));
  for (const SourceImage& image : study_.images) {
    DRTContourImageSequence::Item* item = nullptr;
    if (!add(series->getContourImageSequence(), item)) return;
    failure_ << item->setReferencedSOPClassUID(text_of(image.sop_class_uid));
    failure_ << item->setReferencedSOPInstanceUID(text_of(image.sop_instance_uid));
  }
}

Status StructureSetWriter::describe(const Segment& segment, const std::string& number) {
  DRTStructureSetROISequence::Item* region = nullptr;
  TIDEMARK_TRY(add(set_.getStructureSetROISequence(), region));
  failure_ << region->setROINumber(text_of(number));
  failure_ << region->setReferencedFrameOfReferenceUID(text_of(study_.frame_of_reference_uid));
  failure_ << region->setROIName(
      text_of(short_text(segment.name.empty() ? "Region " + number : segment.name)), OFFalse);
  failure_ << region->setROIGenerationAlgorithm("SEMIAUTOMATIC");
  DRTRTROIObservationsSequence::Item* observation = nullptr;
  TIDEMARK_TRY(add(set_.getRTROIObservationsSequence(), observation));
  failure_ << observation->setObservationNumber(text_of(number))
           << observation->setReferencedROINumber(text_of(number));
  failure_ << observation->setRTROIInterpretedType("") << observation->setROIInterpreter("");
  return failure_.status(file_);
}

Status StructureSetWriter::add_contour(DRTContourSequence& sequence, const Contour& contour, std::int64_t k) {
  DRTContourSequence::Item* item = nullptr;
  TIDEMARK_TRY(add(sequence, item));
  if (const auto& place = study_.places[static_cast<std::size_t>(k)]) {
    DRTContourImageSequence::Item* image = nullptr;
    TIDEMARK_TRY(add(item->getContourImageSequence(), image));
    failure_ << image->setReferencedSOPClassUID(text_of(study_.images[place->image].sop_class_uid));
    failure_ << image->setReferencedSOPInstanceUID(text_of(study_.images[place->image].sop_instance_uid));
    if (!place->frames.empty()) {
      failure_ << image->setReferencedFrameNumber(text_of(fmt::format("{}", fmt::join(place->frames, "\\"))));
    }
  }
  failure_ << item->setContourGeometricType("CLOSED_PLANAR");
  failure_ << item->setNumberOfContourPoints(text_of(fmt::format("{}", contour.size())));
  std::string points;
  for (const glm::dvec2 point : contour) {
    const glm::dvec3 mm = geometry_.to_patient({point.x, point.y, static_cast<double>(k)});
    for (const double value : {mm.x, mm.y, mm.z}) {
      points.append(points.empty() ? "" : "\\").append(coordinate(value, digits_));
    }
  }
  failure_ << item->setContourData(text_of(points), OFFalse);  // not checked number by number
  return failure_.status(file_);
}

Status StructureSetWriter::add_contours(const Segment& segment, const std::string& number,
                                        const Progress& progress) {
  DRTROIContourSequence::Item* region = nullptr;
  TIDEMARK_TRY(add(set_.getROIContourSequence(), region));
  failure_ << region->setReferencedROINumber(text_of(number));
  const auto [red, green, blue] = segment.colour.value_or(kDefaultColour);
  failure_ << region->setROIDisplayColor(text_of(fmt::format("{}\\{}\\{}", red, green, blue)));
  for (const auto& [k, slice] : segment.slices) {
    if (progress.cancelled()) return cancelled_error();
    for (const Contour& contour : contours_of(segment, geometry_, k)) {
      TIDEMARK_TRY(add_contour(region->getContourSequence(), contour, k));
    }
  }
  return failure_.status(file_);
}

Status StructureSetWriter::write(const Progress& progress) {
  identify();
  refer_to_source();
  for (std::size_t n = 0; n < segments_.list.size(); ++n) {
    progress(static_cast<double>(n) / static_cast<double>(segments_.list.size()), "writing contours");
    const std::string number = fmt::format("{}", n + 1);
    TIDEMARK_TRY(describe(segments_.list[n], number));
    TIDEMARK_TRY(add_contours(segments_.list[n], number, progress));
  }
  auto dataset = std::make_unique<DcmDataset>();
  failure_ << set_.write(*dataset);
  TIDEMARK_TRY(failure_.status(file_));
  // Implicit, because a contour of many points is longer than the 65534 bytes that the explicit form of
  // decimal strings can hold (the note on Contour Data in PS3.3 C.8.8.6).
  return save_object(std::move(dataset), EXS_LittleEndianImplicit, file_);
}

}  // namespace

Status write_structure_set(const Segments& segments, SourceFiles source, const fs::path& file,
                           const Progress& progress) {
  return guarded_writing(file, [&]() -> Status {
    TIDEMARK_TRY(require_planes(segments.geometry, file));
    for (const Segment& segment : segments.list) {
      if (segment.phi && segment.phi->geometry.size != segments.geometry.size) {
        return fail(ErrorKind::internal, "{}: phi and its segment have different grids", file.string());
      }
    }
    const auto study = source_study(source, segments.geometry);
    if (!study) return pass_on(study);
    return StructureSetWriter(segments, *study, file).write(progress);
  });
}

}  // namespace tidemark::imaging
