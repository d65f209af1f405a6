#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <system_error>
#include <utility>
#include <vector>

#include "core/atomic_file.h"
#include "core/checked.h"
#include "imaging/dicom/dicom.h"
#include "imaging/dicom/dicom_setup.h"
#include "imaging/dicom/dicom_values.h"
#include "imaging/dicom/write_dicom_file.h"
#include "imaging/guard/guarded.h"

namespace tidemark::imaging {
namespace {

namespace fs = std::filesystem;

// The attributes that all slices of a series share.
struct SeriesIdentity {
  std::string study_uid = make_uid();
  std::string series_uid = make_uid();
  std::string frame_of_reference_uid = make_uid();
  Timestamp now = Timestamp::now();
};

// Writes attributes until the first failure and remembers it.
class AttributeWriter {
 public:
  explicit AttributeWriter(DcmDataset& dataset) : dataset_(dataset) {}
  void text(const DcmTagKey& tag, const std::string& value) {
    keep(dataset_.putAndInsertString(DcmTag(tag), value.c_str()));
  }
  void number(const DcmTagKey& tag, std::int64_t value) {
    keep(dataset_.putAndInsertUint16(DcmTag(tag), static_cast<Uint16>(value)));
  }
  void pixels(const Uint16* words, std::int64_t count) {
    keep(dataset_.putAndInsertUint16Array(DcmTag(DCM_PixelData, EVR_OW), words,
                                          static_cast<unsigned long>(count)));
  }
  [[nodiscard]] const OFCondition& condition() const { return condition_; }

 private:
  void keep(const OFCondition& condition) {
    if (condition_.good()) condition_ = condition;
  }
  DcmDataset& dataset_;
  OFCondition condition_ = EC_Normal;
};

// Patient, General Study, General Series, Frame of Reference and General Equipment (PS3.3 C.7.1 to C.7.5).
void write_common_modules(AttributeWriter& out, const DicomSeriesHeader& header,
                          const SeriesIdentity& identity) {
  const std::string name = short_text(header.patient_name);
  const std::string id = short_text(header.patient_id);
  const std::string description = short_text(header.series_description);
  if (!is_ascii(name + id + description)) out.text(DCM_SpecificCharacterSet, "ISO_IR 192");
  out.text(DCM_PatientName, name);
  out.text(DCM_PatientID, id);
  out.text(DCM_PatientBirthDate, "");
  out.text(DCM_PatientSex, "");

  out.text(DCM_StudyInstanceUID, identity.study_uid);
  out.text(DCM_StudyDate, identity.now.date);
  out.text(DCM_StudyTime, identity.now.time);
  out.text(DCM_ReferringPhysicianName, "");
  out.text(DCM_StudyID, "1");
  out.text(DCM_AccessionNumber, "");

  out.text(DCM_Modality, header.modality);
  out.text(DCM_SeriesInstanceUID, identity.series_uid);
  out.text(DCM_SeriesNumber, "1");
  out.text(DCM_Laterality, "");
  if (!description.empty()) out.text(DCM_SeriesDescription, description);
  out.text(DCM_PatientPosition, "HFS");

  out.text(DCM_FrameOfReferenceUID, identity.frame_of_reference_uid);
  out.text(DCM_PositionReferenceIndicator, "");

  out.text(DCM_Manufacturer, "Tidemark");
  out.text(DCM_ManufacturerModelName, "Tidemark");
}

// The attributes of the CT Image and MR Image modules beyond pixels (PS3.3 C.8.2.1, C.8.3.1).
void write_modality_module(AttributeWriter& out, const Volume& volume, const DicomSeriesHeader& header) {
  const bool is_ct = header.modality == "CT";
  out.text(DCM_SOPClassUID, is_ct ? UID_CTImageStorage : UID_MRImageStorage);
  out.text(DCM_ImageType, is_ct ? "DERIVED\\SECONDARY\\AXIAL" : "DERIVED\\SECONDARY\\OTHER");
  out.text(DCM_AcquisitionNumber, "1");
  if (is_ct) {
    out.text(DCM_KVP, "");
  } else {
    out.text(DCM_ScanningSequence, "RM");
    out.text(DCM_SequenceVariant, "NONE");
    out.text(DCM_ScanOptions, "");
    out.text(DCM_MRAcquisitionType, "");
    out.text(DCM_RepetitionTime, "");
    out.text(DCM_EchoTime, "");
    out.text(DCM_EchoTrainLength, "");
  }
  // The MR Image module has no rescale; its stored values are the values unless something else is said.
  if (is_ct || volume.slope != 1.0 || volume.intercept != 0.0) {
    out.text(DCM_RescaleIntercept, decimal(volume.intercept));
    out.text(DCM_RescaleSlope, decimal(volume.slope));
    out.text(DCM_RescaleType, is_ct ? "HU" : "US");
  }
  if (header.window.width >= 1.0) {
    out.text(DCM_WindowCenter, decimal(header.window.centre));
    out.text(DCM_WindowWidth, decimal(header.window.width));
  }
}

// General Image, Image Plane and Image Pixel (PS3.3 C.7.6.1 to C.7.6.3) of slice k.
void write_slice(AttributeWriter& out, const Volume& volume, const SeriesIdentity& identity,
                 const std::string& sop_instance_uid, std::int64_t k) {
  const Geometry& geometry = volume.geometry;
  out.text(DCM_SOPInstanceUID, sop_instance_uid);
  out.text(DCM_InstanceNumber, fmt::format("{}", k + 1));
  out.text(DCM_ContentDate, identity.now.date);
  out.text(DCM_ContentTime, identity.now.time);
  out.text(DCM_BurnedInAnnotation, "NO");

  const glm::dvec3 position = geometry.to_patient({0.0, 0.0, static_cast<double>(k)});
  const glm::dvec3 row = geometry.direction[0];
  const glm::dvec3 column = geometry.direction[1];
  out.text(DCM_ImagePositionPatient, decimals(position.x, position.y, position.z));
  out.text(DCM_ImageOrientationPatient, decimals(row.x, row.y, row.z, column.x, column.y, column.z));
  // Between rows first, then between columns.
  out.text(DCM_PixelSpacing, decimals(geometry.spacing_mm.y, geometry.spacing_mm.x));
  out.text(DCM_SliceThickness, decimal(geometry.spacing_mm.z));

  const auto* signed_voxels = std::get_if<std::vector<std::int16_t>>(&volume.voxels);
  out.number(DCM_SamplesPerPixel, 1);
  out.text(DCM_PhotometricInterpretation, "MONOCHROME2");
  out.number(DCM_Rows, geometry.size.y);
  out.number(DCM_Columns, geometry.size.x);
  out.number(DCM_BitsAllocated, 16);
  out.number(DCM_BitsStored, 16);
  out.number(DCM_HighBit, 15);
  out.number(DCM_PixelRepresentation, signed_voxels != nullptr ? 1 : 0);

  const std::int64_t count = geometry.size.x * geometry.size.y;
  const std::size_t first = static_cast<std::size_t>(k * count);
  // Signed words have the same bits.
  const Uint16* words = signed_voxels != nullptr
                            ? reinterpret_cast<const Uint16*>(signed_voxels->data() + first)
                            : std::get<std::vector<std::uint16_t>>(volume.voxels).data() + first;
  out.pixels(words, count);
}

// Whether classic single-frame images can hold the volume.
Status check_writable(const Volume& volume, const DicomSeriesHeader& header, const fs::path& folder) {
  const Geometry& geometry = volume.geometry;
  const auto refuse = [&](std::string_view why) {
    return fail(ErrorKind::write, "{}: cannot write a DICOM series: {}", folder.string(), why);
  };
  if (header.modality != "CT" && header.modality != "MR") return refuse("the modality is neither CT nor MR");
  if (std::holds_alternative<std::vector<float>>(volume.voxels)) return refuse("the voxels are float");
  const auto count = checked_product(geometry.size.x, geometry.size.y, geometry.size.z);
  if (!count || *count == 0 || geometry.size.x > 65535 || geometry.size.y > 65535) {
    return refuse("the size is not within 1..65535 columns and rows");
  }
  const auto held =
      std::visit([](const auto& v) { return static_cast<std::int64_t>(v.size()); }, volume.voxels);
  if (held != *count) return refuse("the voxels do not match the size");
  const auto& d = geometry.direction;
  const double along_normal = std::abs(glm::dot(glm::cross(d[0], d[1]), d[2]));
  if (!(std::abs(along_normal - 1.0) < 1e-4)) return refuse("the directions are not orthonormal");
  const auto positive = [](double s) { return std::isfinite(s) && s > 0.0; };
  const glm::dvec3 s = geometry.spacing_mm;
  if (!positive(s.x) || !positive(s.y) || !positive(s.z)) return refuse("the spacing is not positive");
  if (!std::isfinite(volume.slope) || volume.slope == 0.0 || !std::isfinite(volume.intercept)) {
    return refuse("slope and intercept are not usable");
  }
  return {};
}

std::string slice_name(std::int64_t k) {
  return fmt::format("slice-{:05}.dcm", k + 1);
}

// An older series of no more slices may be replaced; nothing else may be in its folder.
Status check_folder(const fs::path& folder, std::int64_t slices) {
  std::error_code error;
  if (!fs::exists(folder, error)) return {};
  std::vector<std::string> names;
  for (std::int64_t k = 0; k < slices; ++k) names.push_back(slice_name(k));
  std::sort(names.begin(), names.end());
  fs::directory_iterator entries(folder, error);
  for (; !error && entries != fs::directory_iterator(); entries.increment(error)) {
    const std::string name = entries->path().filename().string();
    if (!std::binary_search(names.begin(), names.end(), name)) {
      return fail(ErrorKind::write, "{}: cannot write a DICOM series: the folder already holds {}",
                  folder.string(), name);
    }
  }
  if (error)
    return fail(ErrorKind::write, "{}: cannot list the folder: {}", folder.string(), error.message());
  return {};
}

Status write_slice_file(const Volume& volume, const DicomSeriesHeader& header, const SeriesIdentity& identity,
                        std::int64_t k, const fs::path& target) {
  DcmFileFormat file;
  AttributeWriter out(*file.getDataset());
  write_common_modules(out, header, identity);
  write_modality_module(out, volume, header);
  write_slice(out, volume, identity, make_uid(), k);
  if (out.condition().bad()) {
    return fail(ErrorKind::internal, "{}: cannot write: {}", target.string(), out.condition().text());
  }
  return write_dicom_file(file, EXS_LittleEndianExplicit, target);
}

Status write_all(const Volume& volume, const DicomSeriesHeader& header, const fs::path& folder,
                 const Progress& progress) {
  TIDEMARK_TRY(set_up_dicom());
  TIDEMARK_TRY(check_writable(volume, header, folder));
  const std::int64_t slices = volume.geometry.size.z;
  TIDEMARK_TRY(check_folder(folder, slices));

  // The folder takes its name with every slice in it: some slices of a series, or of two, look like a volume.
  auto whole = AtomicFolder::create(folder);
  if (!whole) return pass_on(whole);
  const SeriesIdentity identity;
  for (std::int64_t k = 0; k < slices; ++k) {
    if (progress.cancelled()) return cancelled_error();
    const fs::path slice = whole->temporary_path() / slice_name(k);
    if (Status written = write_slice_file(volume, header, identity, k, slice); !written) {
      const std::string told = (folder / slice_name(k)).string();
      return fail(written.error().kind, "{}: {}", told, without_path(written.error().message, slice));
    }
    progress(static_cast<double>(k + 1) / static_cast<double>(slices), "writing slices");
  }
  return whole->commit();
}

}  // namespace

Status write_dicom_series(const Volume& volume, const DicomSeriesHeader& header, const fs::path& folder,
                          const Progress& progress) {
  return guarded_writing(folder, [&] { return write_all(volume, header, folder, progress); });
}

}  // namespace tidemark::imaging
