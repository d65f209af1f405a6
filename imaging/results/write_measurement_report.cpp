#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmsr/cmr/tid1500.h>
#include <dcmtk/dcmsr/dsrdoc.h>

#include "imaging/dicom/dicom_values.h"
#include "imaging/guard/guarded.h"
#include "imaging/results/dicom_object.h"
#include "imaging/results/measurement_report.h"

namespace tidemark::imaging {
namespace {

namespace fs = std::filesystem;

using Groups = TID1500_MeasurementReport::TID1411_Measurements;

DSRCodedEntryValue coded(const Code& code) {
  return {text_of(code.value), text_of(code.scheme), text_of(code.meaning)};
}

Code code_in(DcmItem& item, const DcmTagKey& sequence) {
  DcmItem* code = nullptr;
  if (item.findAndGetSequenceItem(sequence, code).bad() || code == nullptr) return {};
  return {element_text(*code, DCM_CodeValue), element_text(*code, DCM_CodingSchemeDesignator),
          element_text(*code, DCM_CodeMeaning)};
}

// A segment as the segmentation describes it.
struct DescribedSegment {
  Uint16 number = 0;
  std::string label;
  std::string tracking_id;
  std::string tracking_uid;
  Code type;
};

// What a report takes from a segmentation.
struct ReportedFile {
  ParsedDicom object;
  std::string study_uid;
  std::string series_uid;
  std::string instance_uid;
  std::string source_series_uid;  // empty: it names none
  std::vector<DescribedSegment> segments;
};

CID100_QuantitativeDiagnosticImagingProcedures procedure_of(const std::string& modality) {
  using Procedures = CID100_QuantitativeDiagnosticImagingProcedures;
  if (modality == "CT") return Procedures::CTUnspecifiedBodyRegion;
  if (modality == "MR") return Procedures::MRIUnspecifiedBodyRegion;
  if (modality == "PT") return Procedures::PETUnspecifiedBodyRegion;
  return Procedures::ImagingProcedure;
}

Result<ReportedFile> read(const fs::path& segmentation) {
  auto object = load_object(segmentation, DicomTag{0x7FE0, 0x0010});
  if (!object) return pass_on(object);
  ReportedFile file{std::move(*object), {}, {}, {}, {}, {}};
  DcmDataset& dataset = file.object.dataset();
  file.study_uid = element_text(dataset, DCM_StudyInstanceUID);
  file.series_uid = element_text(dataset, DCM_SeriesInstanceUID);
  file.instance_uid = element_text(dataset, DCM_SOPInstanceUID);
  for (const auto& [uid, name] : {std::pair(&file.study_uid, "StudyInstanceUID"),
                                  {&file.series_uid, "SeriesInstanceUID"},
                                  {&file.instance_uid, "SOPInstanceUID"}}) {
    if (uid->empty())
      return fail(ErrorKind::input, "{}: {} is missing: no report can refer to it", segmentation.string(),
                  name);
  }
  if (element_text(dataset, DCM_SOPClassUID) != UID_SegmentationStorage)
    return fail(ErrorKind::input, "{}: is no DICOM segmentation, to which a report can refer",
                segmentation.string());
  DcmItem* series = nullptr;
  if (dataset.findAndGetSequenceItem(DCM_ReferencedSeriesSequence, series).good() && series != nullptr)
    file.source_series_uid = element_text(*series, DCM_SeriesInstanceUID);
  TIDEMARK_TRY(for_each_item(dataset, DCM_SegmentSequence, [&](DcmItem& item) -> Status {
    DescribedSegment segment;
    item.findAndGetUint16(DCM_SegmentNumber, segment.number);
    segment.label = element_text(item, DCM_SegmentLabel);
    segment.tracking_id = element_text(item, DCM_TrackingID);
    segment.tracking_uid = element_text(item, DCM_TrackingUID);
    segment.type = code_in(item, DCM_SegmentedPropertyTypeCodeSequence);
    file.segments.push_back(std::move(segment));
    return {};
  }));
  return file;
}

class ReportWriter {
 public:
  ReportWriter(const ReportedFile& source, const fs::path& file) : source_(source), file_(file) {}

  Status write(const std::vector<ReportedSegment>& segments, const std::string& modality);

 private:
  void add(const DescribedSegment& segment, const std::vector<ReportedMeasure>& measures);
  void identify(DSRDocument& document);

  const ReportedFile& source_;
  const fs::path& file_;
  FirstFailure failure_;
  TID1500_MeasurementReport report_{CID7021_MeasurementReportDocumentTitles::ImagingMeasurementReport};
};

// TID 1411.
void ReportWriter::add(const DescribedSegment& segment, const std::vector<ReportedMeasure>& measures) {
  failure_ << report_.addVolumetricROIMeasurements();
  Groups& group = report_.getVolumetricROIMeasurements();
  const std::string name = segment.label.empty() ? fmt::format("Segment {}", segment.number) : segment.label;
  failure_ << group.setTrackingIdentifier(text_of(segment.tracking_id.empty() ? name : segment.tracking_id));
  failure_ << group.setTrackingUniqueIdentifier(
      text_of(segment.tracking_uid.empty() ? make_uid() : segment.tracking_uid));
  if (!segment.type.value.empty()) failure_ << group.setFinding(coded(segment.type));
  DSRImageReferenceValue reference(UID_SegmentationStorage, text_of(source_.instance_uid));
  reference.getSegmentList().addItem(segment.number);
  failure_ << group.setReferencedSegment(reference);
  if (!source_.source_series_uid.empty())
    failure_ << group.setSourceSeriesForSegmentation(text_of(source_.source_series_uid));
  for (const ReportedMeasure& measure : measures) {
    failure_ << group.addMeasurement(
        coded(measure.quantity),
        Groups::MeasurementValue(
            text_of(decimal(measure.value)),
            CID7181_AbstractMultiDimensionalImageModelComponentUnits(coded(measure.unit))));
    if (measure.derivation) {
      failure_ << group.getMeasurement().setDerivation(
          CID7464_GeneralRegionOfInterestMeasurementModifiers(coded(*measure.derivation)));
    }
  }
}

// The patient and the study are the segmentation's, the series is a new one.
void ReportWriter::identify(DSRDocument& document) {
  const Timestamp now = Timestamp::now();
  failure_ << document.setSpecificCharacterSetType(DSRTypes::CS_UTF8);
  failure_ << document.createNewSeriesInStudy(text_of(source_.study_uid));
  copy_patient_and_study(source_.object.dataset(), document, failure_);
  failure_ << document.setSeriesNumber("1002") << document.setInstanceNumber("1");
  failure_ << document.setSeriesDescription("Tidemark measurements");
  failure_ << document.setSeriesDate(text_of(now.date)) << document.setSeriesTime(text_of(now.time));
  failure_ << document.setManufacturer("Tidemark") << document.setManufacturerModelName("Tidemark");
  failure_ << document.setDeviceSerialNumber("0") << document.setSoftwareVersions(TIDEMARK_VERSION);
  failure_ << document.getCurrentRequestedProcedureEvidence().addItem(
      text_of(source_.study_uid), text_of(source_.series_uid), UID_SegmentationStorage,
      text_of(source_.instance_uid));
  failure_ << document.completeDocument("All of the segments were measured.");
}

Status ReportWriter::write(const std::vector<ReportedSegment>& segments, const std::string& modality) {
  failure_ << report_.setLanguage(CID5000_Languages::English);
  failure_ << report_.getObservationContext().addDeviceObserver(text_of(make_uid()), "Tidemark", "Tidemark",
                                                                "Tidemark");
  failure_ << report_.addProcedureReported(procedure_of(modality));
  for (const ReportedSegment& segment : segments) add(source_.segments[segment.index], segment.measures);
  DSRDocument document;
  failure_ << document.setTreeFromRootTemplate(report_);
  TIDEMARK_TRY(failure_.status(file_));
  identify(document);
  auto dataset = std::make_unique<DcmDataset>();
  failure_ << document.write(*dataset);
  // DCMTK's own name the machine.
  for (const DcmTagKey& uid : {DCM_SOPInstanceUID, DCM_SeriesInstanceUID})
    failure_ << dataset->putAndInsertString(DcmTag(uid), make_uid().c_str());
  TIDEMARK_TRY(failure_.status(file_));
  return save_object(std::move(dataset), EXS_LittleEndianExplicit, file_);
}

}  // namespace

Status write_measurement_report(const fs::path& segmentation, const std::vector<ReportedSegment>& segments,
                                const std::string& modality, const fs::path& file) {
  return guarded_writing(file, [&]() -> Status {
    auto source = read(segmentation);
    if (!source) return pass_on(source);
    for (const ReportedSegment& segment : segments) {
      if (segment.index >= source->segments.size())
        return fail(ErrorKind::input, "{}: has {} segments, and number {} was measured",
                    segmentation.string(), source->segments.size(), segment.index + 1);
    }
    return ReportWriter(*source, file).write(segments, modality);
  });
}

}  // namespace tidemark::imaging
