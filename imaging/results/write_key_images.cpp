#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmsr/dsrdoc.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "imaging/dicom/dicom_values.h"
#include "imaging/dicom/header_reader.h"
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
  std::vector<std::uint16_t> frames;  // from 1; none of an image of one frame
  SliceHeader header;                 // of the first of them

  // Whether it says where its pixels lie in the patient; several slices side by side have no one place.
  [[nodiscard]] bool has_place() const {
    return header.position_mm && header.orientation && header.pixel_spacing_mm && header.tiles == 1;
  }
  // Column and row, from 0 at the outer corner of the first pixel to the image's size at that of the last
  // one, which no annotation may leave (PS3.3 Table C.10-5); it has a place.
  [[nodiscard]] glm::dvec2 pixel_at(glm::dvec3 place_mm) const {
    const glm::dvec3 way = place_mm - *header.position_mm;
    const auto& [along_row, along_column] = *header.orientation;
    const glm::dvec2 from_first =
        glm::dvec2(glm::dot(way, along_row), glm::dot(way, along_column)) / *header.pixel_spacing_mm;
    return glm::clamp(from_first + 0.5, glm::dvec2(0.0), glm::dvec2(header.frame_columns, header.frame_rows));
  }
};

Result<KeyImage> read_key_image(const SourceImage& image, std::int64_t k,
                                const std::vector<std::uint16_t>& frames) {
  auto slices = read_slice_headers(image.file);
  if (!slices) return tl::unexpected<Error>(slices.error());
  const std::int64_t frame = frames.empty() ? 0 : frames.front() - 1;
  const auto found = std::find_if(slices->begin(), slices->end(),
                                  [&](const SliceHeader& slice) { return slice.frame == frame; });
  if (found == slices->end())
    return fail(ErrorKind::input, "{}: has no frame {}", image.file.string(), frame + 1);
  return KeyImage{k, frames, std::move(*found)};
}

// Whether one presentation state can show both.
bool look_alike(const SliceHeader& a, const SliceHeader& b) {
  const auto look = [](const SliceHeader& one) {
    return std::tie(one.frame_rows, one.frame_columns, one.pixel_spacing_mm, one.slope, one.intercept,
                    one.quantity.rescale_type, one.is_monochrome1);
  };
  return look(a) == look(b);
}

class KeyImageWriter {
 public:
  KeyImageWriter(const Segments& segments, SourceFiles source, const KeyImageFiles& files)
      : segments_(segments), source_(source), files_(files) {}

  Status write(const std::optional<WindowLevel>& window, const std::string& note, const Progress& progress);

 private:
  Status find_images(const Progress& progress);
  Status write_presentation(const std::optional<WindowLevel>& window);
  Status write_selection(const std::string& note);
  // Series and equipment of a new object in the study.
  void identify(DcmDataset& dataset, const char* modality, const char* number, const char* description);
  void refer_to_images(DcmItem& item);
  void refer(DcmItem& item, const KeyImage& image, const std::vector<std::uint16_t>& frames);
  void annotate(DcmDataset& dataset, const KeyImage& image);
  void draw(DcmItem& annotation, const std::vector<glm::dvec2>& outline);
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
  std::string presentation_uid_;  // empty: none
  std::string presentation_series_uid_;
  FirstFailure failure_;
  DcmItem nowhere_;  // takes what has no place after a failure
};

Status KeyImageWriter::find_images(const Progress& progress) {
  auto study = source_study(source_, segments_.geometry);
  if (!study) return pass_on(study);
  study_ = std::move(*study);
  const auto has_image = [&](std::int64_t k) {
    return study_.places[static_cast<std::size_t>(k)].has_value();
  };
  for (const std::int64_t k : key_slices(segments_, has_image)) {
    if (progress.cancelled()) return cancelled_error();
    const SourcePlace& place = *study_.places[static_cast<std::size_t>(k)];
    const SourceImage& image = study_.images[place.image];
    auto found = read_key_image(image, k, place.frames);
    if (!found) return pass_on(found);
    images_.push_back(std::move(*found));
    if (files_.presentation.empty()) continue;
    if (!images_.back().has_place()) {
      return fail(ErrorKind::input, "{}: does not say where its pixels lie: no outline can be drawn on it",
                  image.file.string());
    }
    if (!look_alike(images_.front().header, images_.back().header)) {
      return fail(
          ErrorKind::input,
          "{}: its size, spacing or rescaling differs from that of other key images: one presentation "
          "state cannot show them",
          image.file.string());
    }
  }
  if (images_.empty())
    return fail(ErrorKind::input, "no image shows a voxel of a segment: there are no key images");
  return {};
}

void KeyImageWriter::identify(DcmDataset& dataset, const char* modality, const char* number,
                              const char* description) {
  const Timestamp now = Timestamp::now();
  DcmDataset& from = study_.attributes();
  put(dataset, DCM_SpecificCharacterSet, "ISO_IR 192");
  for (const DcmTagKey& key :
       {DCM_PatientName, DCM_PatientID, DCM_PatientBirthDate, DCM_PatientSex, DCM_StudyDate, DCM_StudyTime,
        DCM_StudyID, DCM_StudyDescription, DCM_AccessionNumber, DCM_ReferringPhysicianName})
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

void KeyImageWriter::refer(DcmItem& item, const KeyImage& image, const std::vector<std::uint16_t>& frames) {
  put(item, DCM_ReferencedSOPClassUID, image.header.sop_class_uid);
  put(item, DCM_ReferencedSOPInstanceUID, image.header.sop_instance_uid);
  if (!frames.empty()) put(item, DCM_ReferencedFrameNumber, fmt::format("{}", fmt::join(frames, "\\")));
}

// Each image once, with all its frames.
void KeyImageWriter::refer_to_images(DcmItem& item) {
  DcmItem& series = add(item, DCM_ReferencedSeriesSequence);
  put(series, DCM_SeriesInstanceUID, study_.series_uid);
  std::map<std::string, std::vector<std::uint16_t>> frames;
  for (const KeyImage& image : images_) {
    auto& all = frames[image.header.sop_instance_uid];
    all.insert(all.end(), image.frames.begin(), image.frames.end());
  }
  for (const KeyImage& image : images_) {
    const auto found = frames.find(image.header.sop_instance_uid);
    if (found == frames.end()) continue;
    refer(add(series, DCM_ReferencedImageSequence), image, found->second);
    frames.erase(found);
  }
}

// Closed, in pieces where it is long. The outline is in pixels.
void KeyImageWriter::draw(DcmItem& annotation, const std::vector<glm::dvec2>& outline) {
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
  for (std::size_t n = 0; n <= outline.size(); ++n) {
    const glm::dvec2 point = outline[n % outline.size()];
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
    refer(add(annotation, DCM_ReferencedImageSequence), image, image.frames);
    put(annotation, DCM_GraphicLayer, layer_of(n));
    glm::dvec2 right(0.0);
    for (const Contour& contour : contours) {
      std::vector<glm::dvec2> outline;
      for (const glm::dvec2 point : contour) {
        outline.push_back(image.pixel_at(grid.to_patient({point.x, point.y, static_cast<double>(image.k)})));
        if (outline.back().x > right.x) right = outline.back();
      }
      draw(annotation, outline);
    }
    if (segment.name.empty()) continue;
    DcmItem& text = add(annotation, DCM_TextObjectSequence);
    put(text, DCM_AnchorPointAnnotationUnits, "PIXEL");
    put(text, DCM_UnformattedTextValue, segment.name);
    const Float32 anchor[] = {static_cast<Float32>(right.x), static_cast<Float32>(right.y)};
    failure_ << text.putAndInsertFloat32Array(DCM_AnchorPoint, anchor, 2);
    put(text, DCM_AnchorPointVisibility, "N");
  }
}

Status KeyImageWriter::write_presentation(const std::optional<WindowLevel>& window) {
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
  const SliceHeader& shown = images_.front().header;
  put_both(area, DCM_DisplayedAreaTopLeftHandCorner, {1, 1});
  put_both(area, DCM_DisplayedAreaBottomRightHandCorner,
           {static_cast<Sint32>(shown.frame_columns), static_cast<Sint32>(shown.frame_rows)});
  put(area, DCM_PresentationSizeMode, "SCALE TO FIT");
  put(area, DCM_PresentationPixelSpacing, decimals(shown.pixel_spacing_mm->y, shown.pixel_spacing_mm->x));
  const std::string& type = shown.quantity.rescale_type;
  put(*dataset, DCM_RescaleIntercept, decimal(shown.intercept));
  put(*dataset, DCM_RescaleSlope, decimal(shown.slope));
  put(*dataset, DCM_RescaleType, !type.empty() ? type : shown.modality == "CT" ? "HU" : "US");
  if (window) {
    DcmItem& values = add(*dataset, DCM_SoftcopyVOILUTSequence);
    put(values, DCM_WindowCenter, decimal(window->centre));
    put(values, DCM_WindowWidth, decimal(window->width));
    // The usual function has no windows below 1 (PS3.3 C.11.2.1.2).
    if (window->width < 1.0) put(values, DCM_VOILUTFunction, "LINEAR_EXACT");
  }
  put(*dataset, DCM_PresentationLUTShape, shown.is_monochrome1 ? "INVERSE" : "IDENTITY");
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
  auto below = DSRTypes::AM_belowCurrent;
  if (!note.empty()) {
    enter(tree.addContentItem(DSRTypes::RT_contains, DSRTypes::VT_Text,
                              std::exchange(below, DSRTypes::AM_afterCurrent)));
    failure_ << tree.getCurrentContentItem().setConceptName({"113012", "DCM", "Key Object Description"});
    failure_ << tree.getCurrentContentItem().setStringValue(text_of(note));
  }
  for (const KeyImage& image : images_) {
    DSRImageReferenceValue reference(text_of(image.header.sop_class_uid),
                                     text_of(image.header.sop_instance_uid));
    for (const std::uint16_t frame : image.frames) reference.getFrameList().addItem(frame);
    if (!presentation_uid_.empty()) {
      failure_ << reference.setPresentationState(DSRCompositeReferenceValue(
          UID_GrayscaleSoftcopyPresentationStateStorage, text_of(presentation_uid_)));
    }
    enter(tree.addContentItem(DSRTypes::RT_contains, DSRTypes::VT_Image,
                              std::exchange(below, DSRTypes::AM_afterCurrent)));
    failure_ << tree.getCurrentContentItem().setImageReference(reference);
    failure_ << document.getCurrentRequestedProcedureEvidence().addItem(
        text_of(study_.study_uid), text_of(study_.series_uid), text_of(image.header.sop_class_uid),
        text_of(image.header.sop_instance_uid));
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

Status KeyImageWriter::write(const std::optional<WindowLevel>& window, const std::string& note,
                             const Progress& progress) {
  TIDEMARK_TRY(find_images(progress));
  if (!files_.presentation.empty()) {
    TIDEMARK_TRY(write_presentation(window));
  }
  return write_selection(note);
}

}  // namespace

std::optional<WindowLevel> window_of_files(const Volume& volume, const WindowLevel& window) {
  return volume.unit.empty() || volume.unit == "HU" ? std::optional(window) : std::nullopt;
}

std::vector<std::int64_t> key_slices(const Segments& segments,
                                     const std::function<bool(std::int64_t k)>& has_image) {
  std::set<std::int64_t> slices;
  for (const Segment& segment : segments.list) {
    std::int64_t most = 0;
    std::int64_t largest = 0;
    for (const auto& [k, voxels] : segment.slices) {
      if (!has_image(k)) continue;
      const auto inside =
          std::count_if(voxels.begin(), voxels.end(), [](std::uint8_t voxel) { return voxel != 0; });
      if (inside <= most) continue;
      most = inside;
      largest = k;
    }
    if (most > 0) slices.insert(largest);
  }
  return {slices.begin(), slices.end()};
}

Status write_key_images(const Segments& segments, SourceFiles source,
                        const std::optional<WindowLevel>& window, const std::string& note,
                        const KeyImageFiles& files, const Progress& progress) {
  return guarded_writing(files.selection, [&]() -> Status {
    if (source.empty()) {
      return fail(ErrorKind::input, "{}: key images refer to images in DICOM", files.selection.string());
    }
    return KeyImageWriter(segments, source, files).write(window, note, progress);
  });
}

}  // namespace tidemark::imaging
