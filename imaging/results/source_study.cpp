#include "imaging/results/source_study.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "imaging/dicom/dicom_values.h"

namespace tidemark {
namespace {

namespace fs = std::filesystem;

constexpr double kTolerance = 0.1;  // of the distance of slices: positions are rounded in files

Status require(const std::string& uid, const fs::path& file, const char* name) {
  if (!uid.empty()) return {};
  return fail(ErrorKind::input, "{}: {} is missing", file.string(), name);
}

// What a source image says about itself before its pixels.
struct ImageHeader {
  SourceImage image;
  std::optional<glm::dvec3> position_mm;
};

Result<ImageHeader> header_of(DcmItem& item, const fs::path& file) {
  ImageHeader header;
  header.image = {text_of(item, DCM_SOPClassUID), text_of(item, DCM_SOPInstanceUID)};
  if (auto good = require(header.image.sop_class_uid, file, "SOPClassUID (0008,0016)"); !good) {
    return pass_on(good);
  }
  if (auto good = require(header.image.sop_instance_uid, file, "SOPInstanceUID (0008,0018)"); !good) {
    return pass_on(good);
  }
  header.position_mm = vector_of(item, DCM_ImagePositionPatient);
  return header;
}

// The slice at whose place the image lies.
std::optional<std::int64_t> slice_of(const ImageHeader& header, const Geometry& geometry) {
  if (!header.position_mm) return std::nullopt;
  const glm::dvec3 normal = geometry.direction[2];
  const double along = glm::dot(*header.position_mm - geometry.origin_mm, normal) / geometry.spacing_mm.z;
  const double nearest = std::round(along);
  if (std::abs(along - nearest) > kTolerance || nearest < 0.0) return std::nullopt;
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

Status read_images(SourceFiles files, const Geometry& geometry, SourceStudy& study) {
  study.image.resize(static_cast<std::size_t>(geometry.size.z));
  for (const fs::path& file : files) {
    const auto object = load_object(file, DCM_ImageOrientationPatient);  // the next after what is needed
    if (!object) return tl::unexpected<Error>(object.error());
    auto header = header_of(*(*object)->getDataset(), file);
    if (!header) return pass_on(header);
    study.images.push_back(std::move(header->image));
    const std::size_t index = study.images.size() - 1;
    if (const auto k = slice_of(*header, geometry)) study.image[static_cast<std::size_t>(*k)] = index;
  }
  // One file for many slices: each of them is in it.
  if (files.size() == 1) study.image.assign(study.image.size(), 0);
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
    study.study_uid = text_of(attributes, DCM_StudyInstanceUID);
    study.series_uid = text_of(attributes, DCM_SeriesInstanceUID);
    if (auto good = require(study.study_uid, files.front(), "StudyInstanceUID (0020,000D)"); !good) {
      return pass_on(good);
    }
    if (auto good = require(study.series_uid, files.front(), "SeriesInstanceUID (0020,000E)"); !good) {
      return pass_on(good);
    }
    // Old images have none; positions of a result need one.
    if (const std::string uid = text_of(attributes, DCM_FrameOfReferenceUID); !uid.empty()) {
      study.frame_of_reference_uid = uid;
    }
    if (auto read = read_images(files, geometry, study); !read) return pass_on(read);
  }
  // All text is UTF-8 now, what we add too.
  study.attributes().putAndInsertString(DCM_SpecificCharacterSet, "ISO_IR 192");
  return study;
}

}  // namespace tidemark
