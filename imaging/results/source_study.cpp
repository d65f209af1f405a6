#include "imaging/results/source_study.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "imaging/dicom/dicom_values.h"
#include "imaging/dicom/header_reader.h"
#include "imaging/dicom/slice_places.h"

namespace tidemark::imaging {
namespace {

namespace fs = std::filesystem;

constexpr double kSliceTolerance = 0.1;  // of the distance of slices: positions are rounded in files

// The slice at whose place an image lies.
std::optional<std::int64_t> slice_at(glm::dvec3 position_mm, const Geometry& geometry) {
  const glm::dvec3 normal = geometry.direction[2];
  const double along = glm::dot(position_mm - geometry.origin_mm, normal) / geometry.spacing_mm.z;
  const double nearest = std::round(along);
  if (!(std::abs(along - nearest) <= kSliceTolerance) || nearest < 0.0) return std::nullopt;
  if (nearest > static_cast<double>(geometry.size.z - 1)) return std::nullopt;
  return static_cast<std::int64_t>(nearest);
}

SourceStudy anonymous_study(const Geometry& geometry) {
  SourceStudy study;
  study.first = std::make_unique<DcmFileFormat>();
  study.study_uid = make_uid();
  study.frame_of_reference_uid = make_uid();
  study.places.resize(static_cast<std::size_t>(geometry.size.z));
  const Timestamp now = Timestamp::now();
  const auto put = [&](const DcmTagKey& key, const std::string& value) {
    study.attributes().putAndInsertString(DcmTag(key), value.c_str());
  };
  put(DCM_PatientName, "Anonymous");
  put(DCM_PatientID, "ANONYMOUS");
  put(DCM_StudyInstanceUID, study.study_uid);
  put(DCM_StudyDate, now.date);
  put(DCM_StudyTime, now.time);
  put(DCM_StudyID, "1");
  for (const DcmTagKey& key :
       {DCM_PatientBirthDate, DCM_PatientSex, DCM_ReferringPhysicianName, DCM_AccessionNumber}) {
    put(key, "");
  }
  return study;
}

// Whether an image of the grid's own size lies at a slice's place along the normal, but elsewhere in its
// plane: it is of another stack, or of slices that were taken as they lie although a tilted gantry moved
// them.
bool is_beside(const SliceHeader& image, std::int64_t k, const Geometry& geometry) {
  if (image.columns != geometry.size.x || image.rows != geometry.size.y) return false;
  const glm::dvec3 slice(0.0, 0.0, static_cast<double>(k));
  const glm::dvec3 at = geometry.to_voxel(*image.position_mm) - slice;
  if (std::max(std::abs(at.x), std::abs(at.y)) <= kSliceTolerance) return false;
  // Slices that count as straight when they are loaded may have drifted farther than that.
  const glm::dvec2 sideways = glm::dvec2(at) * glm::dvec2(geometry.spacing_mm);
  return !is_straight(glm::length(sideways), slice.z * geometry.spacing_mm.z);
}

// As the image tells it, else by the compression that its pixels have.
Result<SourceLoss> loss_of(const SliceHeader& image) {
  const auto object = load_object(image.file, kPixelData);
  if (!object) return pass_on(object);
  SourceLoss loss{element_text(object->dataset(), DCM_LossyImageCompressionRatio),
                  element_text(object->dataset(), DCM_LossyImageCompressionMethod)};
  const auto& fragments = object->checked().fragments;
  const bool is_told = !loss.ratio.empty() || !loss.method.empty();
  if (is_told || !object->syntax().is_lossy || !fragments || fragments->count == 0) return loss;
  const auto bits = static_cast<double>(image.frames * image.frame_rows * image.frame_columns) *
                    static_cast<double>(image.bits_allocated);
  loss.ratio = fmt::format("{:.2f}", bits / 8.0 / static_cast<double>(fragments->end - fragments->begin));
  switch (object->syntax().frames) {
    case FrameCoding::jpeg_ls:
      loss.method = "ISO_14495_1";
      break;
    case FrameCoding::jpeg_2000:
      loss.method = "ISO_15444_1";
      break;
    default:
      loss.method = "ISO_10918_1";
  }
  return loss;
}

// Images that were stripped of their UIDs cannot be referred to.
Status read_images(SourceFiles files, const Geometry& geometry, SourceStudy& study) {
  std::vector<fs::path> beside(study.places.size());  // of each slice an image beside it
  for (const fs::path& file : files) {
    const auto slices = read_slice_headers(file);
    if (!slices) return tl::unexpected<Error>(slices.error());
    const SliceHeader& first = slices->front();
    if (first.is_lossy && !study.loss) {
      auto loss = loss_of(first);
      if (!loss) return pass_on(loss);
      study.loss = std::move(*loss);
    }
    if (first.sop_class_uid.empty() || first.sop_instance_uid.empty()) continue;
    const std::size_t image = study.images.size();
    study.images.push_back({first.sop_class_uid, first.sop_instance_uid, file});
    // An image that is all there is needs no place among others.
    const bool is_alone = files.size() == 1 && slices->size() == 1 && geometry.size.z == 1;
    for (const SliceHeader& slice : *slices) {
      auto k = slice.position_mm ? slice_at(*slice.position_mm, geometry) : std::nullopt;
      if (is_alone && !slice.position_mm) k = 0;
      if (!k) continue;
      if (slice.position_mm && is_beside(slice, *k, geometry)) {
        beside[static_cast<std::size_t>(*k)] = file;
        continue;
      }
      auto& place = study.places[static_cast<std::size_t>(*k)];
      if (!place || place->image != image) place = SourcePlace{image, {}};
      if (slice.frames > 1) place->frames.push_back(static_cast<std::uint16_t>(slice.frame + 1));
    }
  }
  // Results would be in coordinates that are not the patient's.
  for (std::size_t k = 0; k < beside.size(); ++k) {
    if (study.places[k] || beside[k].empty()) continue;
    return fail(ErrorKind::input,
                "{}: lies beside its slice of the volume (a gantry tilt that was kept?): a result would have "
                "no place in the patient",
                beside[k].string());
  }
  return {};
}

}  // namespace

Result<SourceStudy> source_study(SourceFiles files, const Geometry& geometry) {
  SourceStudy study = anonymous_study(geometry);
  if (!files.empty()) {
    auto first = load_object(files.front(), kPixelData);
    if (!first) return pass_on(first);
    study.first = first->take();
    DcmDataset& attributes = study.attributes();
    // UIDs that the source lacks are new: a result needs them.
    const auto take = [&](const DcmTagKey& key, std::string& uid) {
      if (const std::string its_own = element_text(attributes, key); !its_own.empty()) uid = its_own;
      attributes.putAndInsertString(DcmTag(key), uid.c_str());
    };
    take(DCM_StudyInstanceUID, study.study_uid);
    take(DCM_FrameOfReferenceUID, study.frame_of_reference_uid);
    study.series_uid = element_text(attributes, DCM_SeriesInstanceUID);
    if (!study.series_uid.empty()) {
      TIDEMARK_TRY(read_images(files, geometry, study));
    }
  }
  // All text is UTF-8 now, what we add too.
  study.attributes().putAndInsertString(DCM_SpecificCharacterSet, "ISO_IR 192");
  return study;
}

}  // namespace tidemark::imaging
