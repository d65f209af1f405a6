#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmsr/dsrdoc.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "imaging/dicom/dicom_values.h"
#include "imaging/guard/guarded.h"
#include "imaging/results/contours.h"
#include "imaging/results/key_images.h"
#include "imaging/results/source_study.h"

namespace tidemark::imaging {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSelectionSeries = "1003";
constexpr const char* kPresentationSeries = "1004";
// Of a polyline, whose coordinates have 65534 bytes at most in the explicit form of their value (FL).
constexpr std::size_t kMostPoints = 8000;

// A key image as its file has it.
struct KeyImage {
  std::int64_t k = 0;
  SourceImage image;
  std::vector<std::uint16_t> frames;
};

// What all key images share.
struct Display {
  std::uint16_t rows = 0;
  std::uint16_t columns = 0;
  std::string spacing;  // row\column, mm; empty: not known
  std::string slope;    // empty: no Modality LUT
  std::string intercept;
  std::string rescale_type;
  bool inverse = false;  // MONOCHROME1

  bool operator==(const Display&) const = default;
};

Result<Display> display_of(const fs::path& file) {
  constexpr DicomTag kPixelData{0x7fe0, 0x0010};
  auto object = load_object(file, kPixelData);
  if (!object) return pass_on(object);
  DcmDataset& dataset = object->dataset();
  Display display;
  dataset.findAndGetUint16(DCM_Rows, display.rows);
  dataset.findAndGetUint16(DCM_Columns, display.columns);
  display.spacing = element_text(dataset, DCM_PixelSpacing);
  display.slope = element_text(dataset, DCM_RescaleSlope);
  display.intercept = element_text(dataset, DCM_RescaleIntercept);
  display.rescale_type = element_text(dataset, DCM_RescaleType);
  display.inverse = element_text(dataset, DCM_PhotometricInterpretation) == "MONOCHROME1";
  return display;
}

class KeyImageWriter {
 public:
  KeyImageWriter(const Segments& segments, SourceFiles source, const KeyImageFiles& files)
      : segments_(segments), source_(source), files_(files) {}

  Status write(const WindowLevel& window, const std::string& note);

 private:
  Status find_images();
  Status write_presentation(const WindowLevel& window);
  Status write_selection(const std::string& note);
  // Series and equipment of a new object in the study.
  void identify(DcmDataset& dataset, const char* modality, const char* number, const char* description);
  void refer_to_images(DcmItem& item);
  void annotate(DcmDataset& dataset, const KeyImage& image);
  void draw(DcmItem& annotation, const Contour& contour);
  void put(DcmItem& item, const DcmTagKey& key, const std::string& text) {
    failure_ << item.putAndInsertString(DcmTag(key), text.c_str());
  }
  // DCMTK's short forms put one such number alone.
  void put_both(DcmItem& item, const DcmTagKey& key, const std::array<Sint32, 2>& numbers) {
    auto element = std::make_unique<DcmSignedLong>(DcmTag(key));
    failure_ << element->putSint32Array(numbers.data(), numbers.size());
    failure_ << item.insert(element.release(), OFTrue);
  }
  DcmItem& add(DcmItem& parent, const DcmTagKey& sequence) {
    DcmItem* item = nullptr;
    constexpr long kNewLast = -2;
    failure_ << parent.findOrCreateSequenceItem(DcmTag(sequence), item, kNewLast);
    return item != nullptr ? *item : nowhere_;
  }

  const Segments& segments_;
  SourceFiles source_;
  const KeyImageFiles& files_;
  SourceStudy study_;
  std::vector<KeyImage> images_;
  Display display_;
  std::string presentation_uid_;  // empty: none
  std::string presentation_series_uid_;
  FirstFailure failure_;
  DcmItem nowhere_;  // takes what has no place after a failure
};

Status KeyImageWriter::find_images() {
  auto study = source_study(source_, segments_.geometry);
  if (!study) return pass_on(study);
  study_ = std::move(*study);
  for (const std::int64_t k : key_slices(segments_)) {
    const auto& place = study_.places[static_cast<std::size_t>(k)];
    if (!place) {
      return fail(ErrorKind::input, "{}: no image lies at slice {}, which would be a key image",
                  source_.front().parent_path().string(), k + 1);
    }
    const SourceImage& image = study_.images[place->image];
    images_.push_back({k, image, place->frames});
    const auto display = display_of(image.file);
    if (!display) return pass_on(display);
    if (images_.size() > 1 && !(display_ == *display) && !files_.presentation.empty()) {
      return fail(
          ErrorKind::input,
          "{}: its size, spacing or rescaling differs from that of other key images: one presentation "
          "state cannot show them",
          image.file.string());
    }
    display_ = *display;
  }
  if (images_.empty()) return fail(ErrorKind::input, "no segment has a voxel, and there are no key images");
  return {};
}

void KeyImageWriter::identify(DcmDataset& dataset, const char* modality, const char* number,
                              const char* description) {
  const Timestamp now = Timestamp::now();
  DcmDataset& from = study_.attributes();
  put(dataset, DCM_SpecificCharacterSet, "ISO_IR 192");
  for (const DcmTagKey& key :
       {DCM_PatientName, DCM_PatientID, DCM_PatientBirthDate, DCM_PatientSex, DCM_StudyDate, DCM_StudyTime,
        DCM_StudyID, DCM_AccessionNumber, DCM_ReferringPhysicianName})
    put(dataset, key, element_text(from, key));
  put(dataset, DCM_StudyInstanceUID, study_.study_uid);
  put(dataset, DCM_SeriesInstanceUID, make_uid());
  put(dataset, DCM_Modality, modality);
  put(dataset, DCM_SeriesNumber, number);
  put(dataset, DCM_SeriesDescription, description);
  put(dataset, DCM_SeriesDate, now.date);
  put(dataset, DCM_SeriesTime, now.time);
  put(dataset, DCM_Manufacturer, "Tidemark");
  put(dataset, DCM_ManufacturerModelName, "Tidemark");
  put(dataset, DCM_DeviceSerialNumber, "0");
  put(dataset, DCM_SoftwareVersions, TIDEMARK_VERSION);
  put(dataset, DCM_InstanceNumber, "1");
}

void refer(DcmItem& item, const KeyImage& image, FirstFailure& failure) {
  failure << item.putAndInsertString(DCM_ReferencedSOPClassUID, image.image.sop_class_uid.c_str());
  failure << item.putAndInsertString(DCM_ReferencedSOPInstanceUID, image.image.sop_instance_uid.c_str());
  if (image.frames.empty()) return;
  failure << item.putAndInsertString(DCM_ReferencedFrameNumber,
                                     fmt::format("{}", fmt::join(image.frames, "\\")).c_str());
}

void KeyImageWriter::refer_to_images(DcmItem& item) {
  DcmItem& series = add(item, DCM_ReferencedSeriesSequence);
  put(series, DCM_SeriesInstanceUID, study_.series_uid);
  for (const KeyImage& image : images_) refer(add(series, DCM_ReferencedImageSequence), image, failure_);
}

// Closed, in pieces where it is long. The middle of the first pixel is (1, 1) (PS3.3 C.10.5.1.2).
void KeyImageWriter::draw(DcmItem& annotation, const Contour& contour) {
  std::vector<Float32> points;
  const auto end_piece = [&] {
    DcmItem& line = add(annotation, DCM_GraphicObjectSequence);
    put(line, DCM_GraphicAnnotationUnits, "PIXEL");
    failure_ << line.putAndInsertUint16(DCM_GraphicDimensions, 2);
    failure_ << line.putAndInsertUint16(DCM_NumberOfGraphicPoints, static_cast<Uint16>(points.size() / 2));
    failure_ << line.putAndInsertFloat32Array(DCM_GraphicData, points.data(), points.size());
    put(line, DCM_GraphicType, "POLYLINE");
    put(line, DCM_GraphicFilled, "N");
  };
  for (std::size_t n = 0; n <= contour.size(); ++n) {
    const glm::dvec2 point = contour[n % contour.size()] + 1.0;
    points.insert(points.end(), {static_cast<Float32>(point.x), static_cast<Float32>(point.y)});
    if (points.size() / 2 < kMostPoints) continue;
    end_piece();
    points.erase(points.begin(), points.end() - 2);
  }
  if (points.size() > 2) end_piece();
}

std::string layer_of(std::size_t segment) {
  return fmt::format("SEGMENT{}", segment + 1);
}

void KeyImageWriter::annotate(DcmDataset& dataset, const KeyImage& image) {
  const Geometry& grid = segments_.geometry;
  for (std::size_t n = 0; n < segments_.list.size(); ++n) {
    const Segment& segment = segments_.list[n];
    const std::vector<Contour> contours = contours_of(segment, grid, image.k);
    if (contours.empty()) continue;
    DcmItem& annotation = add(dataset, DCM_GraphicAnnotationSequence);
    refer(add(annotation, DCM_ReferencedImageSequence), image, failure_);
    put(annotation, DCM_GraphicLayer, layer_of(n));
    glm::dvec2 right = contours.front().front();
    for (const Contour& contour : contours) {
      for (const glm::dvec2 point : contour) right = point.x > right.x ? point : right;
      draw(annotation, contour);
    }
    if (segment.name.empty()) continue;
    DcmItem& text = add(annotation, DCM_TextObjectSequence);
    put(text, DCM_AnchorPointAnnotationUnits, "PIXEL");
    put(text, DCM_UnformattedTextValue, segment.name);
    const Float32 anchor[] = {static_cast<Float32>(right.x + 1.0), static_cast<Float32>(right.y + 1.0)};
    failure_ << text.putAndInsertFloat32Array(DCM_AnchorPoint, anchor, 2);
    put(text, DCM_AnchorPointVisibility, "N");
  }
}

Status KeyImageWriter::write_presentation(const WindowLevel& window) {
  auto dataset = std::make_unique<DcmDataset>();
  const Timestamp now = Timestamp::now();
  presentation_uid_ = make_uid();
  put(*dataset, DCM_SOPClassUID, UID_GrayscaleSoftcopyPresentationStateStorage);
  put(*dataset, DCM_SOPInstanceUID, presentation_uid_);
  identify(*dataset, "PR", kPresentationSeries, "Tidemark outlines");
  put(*dataset, DCM_Laterality, "");  // of a paired body part, which nothing says
  presentation_series_uid_ = element_text(*dataset, DCM_SeriesInstanceUID);
  put(*dataset, DCM_PresentationCreationDate, now.date);
  put(*dataset, DCM_PresentationCreationTime, now.time);
  put(*dataset, DCM_ContentLabel, "OUTLINES");
  put(*dataset, DCM_ContentDescription, "Outlines of segments");
  put(*dataset, DCM_ContentCreatorName, "");
  refer_to_images(*dataset);

  DcmItem& area = add(*dataset, DCM_DisplayedAreaSelectionSequence);
  put_both(area, DCM_DisplayedAreaTopLeftHandCorner, {1, 1});
  put_both(area, DCM_DisplayedAreaBottomRightHandCorner, {display_.columns, display_.rows});
  put(area, DCM_PresentationSizeMode, "SCALE TO FIT");
  if (display_.spacing.empty()) {
    put(area, DCM_PresentationPixelAspectRatio, "1\\1");
  } else {
    put(area, DCM_PresentationPixelSpacing, display_.spacing);
  }
  if (!display_.slope.empty()) {
    put(*dataset, DCM_RescaleIntercept, display_.intercept.empty() ? "0" : display_.intercept);
    put(*dataset, DCM_RescaleSlope, display_.slope);
    put(*dataset, DCM_RescaleType, display_.rescale_type.empty() ? "US" : display_.rescale_type);
  }
  DcmItem& values = add(*dataset, DCM_SoftcopyVOILUTSequence);
  put(values, DCM_WindowCenter, decimal(window.centre));
  put(values, DCM_WindowWidth, decimal(std::max(1.0, window.width)));
  put(*dataset, DCM_PresentationLUTShape, display_.inverse ? "INVERSE" : "IDENTITY");
  for (const KeyImage& image : images_) annotate(*dataset, image);
  for (std::size_t n = 0; n < segments_.list.size(); ++n) {
    DcmItem& layer = add(*dataset, DCM_GraphicLayerSequence);
    put(layer, DCM_GraphicLayer, layer_of(n));
    put(layer, DCM_GraphicLayerOrder, fmt::format("{}", n + 1));
    if (!segments_.list[n].name.empty())
      put(layer, DCM_GraphicLayerDescription, short_text(segments_.list[n].name));
  }
  TIDEMARK_TRY(failure_.status(files_.presentation));
  return save_object(std::move(dataset), EXS_LittleEndianExplicit, files_.presentation);
}

Status KeyImageWriter::write_selection(const std::string& note) {
  DSRDocument document(DSRTypes::DT_KeyObjectSelectionDocument);
  failure_ << document.setSpecificCharacterSetType(DSRTypes::CS_UTF8);
  failure_ << document.createNewSeriesInStudy(text_of(study_.study_uid));
  DSRDocumentTree& tree = document.getTree();
  const auto enter = [&](size_t added) { failure_ << (added > 0 ? EC_Normal : EC_IllegalCall); };
  enter(tree.addContentItem(DSRTypes::RT_isRoot, DSRTypes::VT_Container));
  failure_ << tree.getCurrentContentItem().setConceptName({"113000", "DCM", "Of Interest"});
  failure_ << tree.getCurrentContentItem().setTemplateIdentification("2010", "DCMR");
  enter(tree.addContentItem(DSRTypes::RT_contains, DSRTypes::VT_Text, DSRTypes::AM_belowCurrent));
  failure_ << tree.getCurrentContentItem().setConceptName({"113012", "DCM", "Key Object Description"});
  failure_ << tree.getCurrentContentItem().setStringValue(text_of(note));
  for (const KeyImage& image : images_) {
    DSRImageReferenceValue reference(text_of(image.image.sop_class_uid),
                                     text_of(image.image.sop_instance_uid));
    for (const std::uint16_t frame : image.frames) reference.getFrameList().addItem(frame);
    if (!presentation_uid_.empty()) {
      failure_ << reference.setPresentationState(DSRCompositeReferenceValue(
          UID_GrayscaleSoftcopyPresentationStateStorage, text_of(presentation_uid_)));
    }
    enter(tree.addContentItem(DSRTypes::RT_contains, DSRTypes::VT_Image));
    failure_ << tree.getCurrentContentItem().setImageReference(reference);
    failure_ << document.getCurrentRequestedProcedureEvidence().addItem(
        text_of(study_.study_uid), text_of(study_.series_uid), text_of(image.image.sop_class_uid),
        text_of(image.image.sop_instance_uid));
  }
  if (!presentation_uid_.empty()) {
    failure_ << document.getCurrentRequestedProcedureEvidence().addItem(
        text_of(study_.study_uid), text_of(presentation_series_uid_),
        UID_GrayscaleSoftcopyPresentationStateStorage, text_of(presentation_uid_));
  }
  TIDEMARK_TRY(failure_.status(files_.selection));
  auto dataset = std::make_unique<DcmDataset>();
  failure_ << document.write(*dataset);
  identify(*dataset, "KO", kSelectionSeries, "Tidemark key images");
  put(*dataset, DCM_SOPInstanceUID, make_uid());  // DCMTK's own names the machine
  TIDEMARK_TRY(failure_.status(files_.selection));
  return save_object(std::move(dataset), EXS_LittleEndianExplicit, files_.selection);
}

Status KeyImageWriter::write(const WindowLevel& window, const std::string& note) {
  TIDEMARK_TRY(find_images());
  if (!files_.presentation.empty()) {
    TIDEMARK_TRY(write_presentation(window));
  }
  return write_selection(note);
}

}  // namespace

std::vector<std::int64_t> key_slices(const Segments& segments) {
  std::set<std::int64_t> slices;
  for (const Segment& segment : segments.list) {
    const auto inside = [](const auto& slice) {
      return std::count_if(slice.second.begin(), slice.second.end(),
                           [](std::uint8_t voxel) { return voxel != 0; });
    };
    const auto largest =
        std::max_element(segment.slices.begin(), segment.slices.end(),
                         [&](const auto& a, const auto& b) { return inside(a) < inside(b); });
    if (largest != segment.slices.end() && inside(*largest) > 0) slices.insert(largest->first);
  }
  return {slices.begin(), slices.end()};
}

Status write_key_images(const Segments& segments, SourceFiles source, const WindowLevel& window,
                        const std::string& note, const KeyImageFiles& files) {
  return guarded_writing(files.selection, [&]() -> Status {
    if (source.empty()) {
      return fail(ErrorKind::input, "{}: key images refer to images in DICOM", files.selection.string());
    }
    return KeyImageWriter(segments, source, files).write(window, note);
  });
}

}  // namespace tidemark::imaging
