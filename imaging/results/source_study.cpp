#include "imaging/results/source_study.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "imaging/dicom/dicom_values.h"

namespace tidemark {
namespace {

namespace fs = std::filesystem;

constexpr double kTolerance = 0.1;  // of the distance of slices: positions are rounded in files

// The slice at whose place an image lies.
std::optional<std::int64_t> slice_at(glm::dvec3 position_mm, const Geometry& geometry) {
  const glm::dvec3 normal = geometry.direction[2];
  const double along = glm::dot(position_mm - geometry.origin_mm, normal) / geometry.spacing_mm.z;
  const double nearest = std::round(along);
  if (!(std::abs(along - nearest) <= kTolerance) || nearest < 0.0) return std::nullopt;
  if (nearest > static_cast<double>(geometry.size.z - 1)) return std::nullopt;
  return static_cast<std::int64_t>(nearest);
}

SourceStudy anonymous_study(const Geometry& geometry) {
  SourceStudy study;
  study.first = std::make_unique<DcmFileFormat>();
  study.study_uid = make_uid();
  study.frame_of_reference_uid = make_uid();
  study.image.resize(static_cast<std::size_t>(geometry.size.z));
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

// Of images that are the grid's slices, pixel by pixel: an image elsewhere in its plane belongs to slices
// that were taken as they lie although they move sideways (a tilted gantry). Results would be told in
// coordinates that are not the patient's.
Status require_in_place(DcmItem& item, glm::dvec3 position_mm, std::int64_t k, const Geometry& geometry,
                        const fs::path& file) {
  long int columns = 0;
  long int rows = 0;
  item.findAndGetLongInt(DCM_Columns, columns);
  item.findAndGetLongInt(DCM_Rows, rows);
  if (columns != geometry.size.x || rows != geometry.size.y) return {};
  const glm::dvec3 beside = geometry.to_voxel(position_mm) - glm::dvec3(0.0, 0.0, static_cast<double>(k));
  if (std::max(std::abs(beside.x), std::abs(beside.y)) <= kTolerance) return {};
  return fail(
      ErrorKind::input,
      "{}: lies {:.1f} x {:.1f} pixels beside its slice of the volume (a gantry tilt that was kept?): "
      "a result would have no place in the patient",
      file.string(), std::abs(beside.x), std::abs(beside.y));
}

// Images that were stripped of their UIDs cannot be referred to.
Status read_images(SourceFiles files, const Geometry& geometry, SourceStudy& study) {
  for (const fs::path& file : files) {
    const auto object = load_object(file, DCM_BitsAllocated);  // the next after what is needed
    if (!object) return tl::unexpected<Error>(object.error());
    DcmItem& item = *(*object)->getDataset();
    SourceImage image{text_of(item, DCM_SOPClassUID), text_of(item, DCM_SOPInstanceUID)};
    if (image.sop_class_uid.empty() || image.sop_instance_uid.empty()) continue;
    study.images.push_back(std::move(image));
    const auto position = vector_of(item, DCM_ImagePositionPatient);
    const auto k = position ? slice_at(*position, geometry) : std::nullopt;
    if (!k) continue;
    if (auto in_place = require_in_place(item, *position, *k, geometry, file); !in_place) return in_place;
    study.image[static_cast<std::size_t>(*k)] = study.images.size() - 1;
  }
  // One file for many slices: each of them is in it.
  if (files.size() == 1 && !study.images.empty()) study.image.assign(study.image.size(), 0);
  return {};
}

}  // namespace

Result<SourceStudy> source_study(SourceFiles files, const Geometry& geometry) {
  SourceStudy study = anonymous_study(geometry);
  if (!files.empty()) {
    auto first = load_object(files.front(), DCM_PixelData);
    if (!first) return pass_on(first);
    study.first = std::move(*first);
    DcmDataset& attributes = study.attributes();
    // What the source was stripped of, or never had, is new: a result needs it.
    const auto take = [&](const DcmTagKey& key, std::string& uid) {
      if (const std::string its_own = text_of(attributes, key); !its_own.empty()) uid = its_own;
      attributes.putAndInsertString(DcmTag(key), uid.c_str());
    };
    take(DCM_StudyInstanceUID, study.study_uid);
    take(DCM_FrameOfReferenceUID, study.frame_of_reference_uid);
    study.series_uid = text_of(attributes, DCM_SeriesInstanceUID);
    if (!study.series_uid.empty()) {
      if (auto read = read_images(files, geometry, study); !read) return pass_on(read);
    }
  }
  // All text is UTF-8 now, what we add too.
  study.attributes().putAndInsertString(DCM_SpecificCharacterSet, "ISO_IR 192");
  return study;
}

}  // namespace tidemark
