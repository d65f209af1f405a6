#include <itkImageIORegion.h>
#include <itkMetaDataObject.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "core/atomic_file.h"
#include "imaging/files/volume_file.h"
#include "imaging/files/volume_header.h"

namespace tidemark::imaging {
namespace {

constexpr std::int64_t kLongestNiftiAxis = std::numeric_limits<std::int16_t>::max();

// Writes a NIfTI file anew without the codes of a place in the patient, which ITK always gives it. Says
// whether that went well.
bool clear_nifti_place(const std::filesystem::path& file) {
  constexpr std::size_t kCodes = 252;  // qform_code and sform_code
  auto cleared = AtomicFile::create(file);
  if (!cleared) return false;
  const gzFile from = gzopen(file.c_str(), "rb");  // reads files that are not gzip as they are
  const gzFile to = gzopen(cleared->temporary_path().c_str(), files::has_suffix(file, ".gz") ? "wb" : "wbT");
  bool is_good = from != nullptr && to != nullptr;
  std::vector<char> some(std::size_t{1} << 20);
  for (bool is_first = true; is_good; is_first = false) {
    const int count = gzread(from, some.data(), static_cast<unsigned>(some.size()));
    is_good = count >= 0;
    if (count <= 0) break;
    if (is_first) std::fill_n(some.begin() + kCodes, 2 * sizeof(std::int16_t), '\0');
    is_good = gzwrite(to, some.data(), static_cast<unsigned>(count)) == count;
  }
  if (from != nullptr) gzclose_r(from);
  if (to != nullptr && gzclose_w(to) != Z_OK) is_good = false;
  return is_good && cleared->commit();
}

void write_through_itk(const std::filesystem::path& file, const Geometry& geometry, itk::IOComponentEnum type,
                       const void* voxels) {
  const files::Format format = *files::format_of(file);
  const auto io = files::make_image_io(format, file);
  if (!geometry.oriented && format == files::Format::nrrd) {
    itk::EncapsulateMetaData<std::string>(io->GetMetaDataDictionary(), "NRRD_space", "3D-right-handed");
  }
  io->SetNumberOfDimensions(3);
  io->SetPixelType(itk::IOPixelEnum::SCALAR);
  io->SetComponentType(type);
  io->SetNumberOfComponents(1);
  io->SetByteOrderToLittleEndian();
  io->SetUseCompression(!files::has_suffix(file, ".nii"));
  itk::ImageIORegion region(3);
  for (unsigned axis = 0; axis < 3; ++axis) {
    const int a = static_cast<int>(axis);
    io->SetDimensions(axis, static_cast<itk::SizeValueType>(geometry.size[a]));
    io->SetSpacing(axis, geometry.spacing_mm[a]);
    io->SetOrigin(axis, geometry.origin_mm[a]);
    const glm::dvec3 column = geometry.direction[a];
    io->SetDirection(axis, std::vector<double>{column.x, column.y, column.z});
    region.SetIndex(axis, 0);
    region.SetSize(axis, static_cast<itk::SizeValueType>(geometry.size[a]));
  }
  io->SetIORegion(region);
  io->Write(voxels);
}

// Not every library behind ITK reports a short write, so the file is checked as one that is to be read: its
// header, its length, and when compressed its whole stream.
Status verify(const std::filesystem::path& file, const Geometry& geometry) {
  auto header = files::check_header(file);
  if (!header) return pass_on(header);
  TIDEMARK_TRY(files::check_stream(header->layout));
  if (!same_grid(header->geometry, geometry, 1e-2)) {
    return fail(ErrorKind::write, "the format cannot hold this geometry");
  }
  return {};
}

Status write_image(const std::filesystem::path& target, const Geometry& geometry, itk::IOComponentEnum type,
                   std::size_t count, const void* voxels) {
  const std::string name = target.string();
  if (!is_writable_volume_file(target)) {
    return fail(ErrorKind::usage, "{}: cannot write this format: use .nii, .nii.gz, .nrrd or .mha", name);
  }
  if (geometry.voxel_count() <= 0 || geometry.voxel_count() != static_cast<std::int64_t>(count)) {
    return fail(ErrorKind::internal, "{}: {} voxels for a grid of {}", name, count, geometry.voxel_count());
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (files::format_of(target) == files::Format::nifti && geometry.size[axis] > kLongestNiftiAxis) {
      return fail(ErrorKind::write, "{}: NIfTI-1 holds at most {} voxels along an axis", name,
                  kLongestNiftiAxis);
    }
  }
  auto file = AtomicFile::create(target);
  if (!file) return pass_on(file);
  const files::ItkScope scope;
  const auto itk_name =
      files::ItkName::create(*files::format_of(target), file->temporary_path(), files::ItkName::Use::write);
  if (!itk_name) return pass_on(itk_name);
  try {
    write_through_itk(itk_name->path(), geometry, type, voxels);
  } catch (const std::exception& exception) {
    return fail(ErrorKind::write, "{}: cannot write: {}", name, files::one_line(exception));
  }
  const bool has_codes_to_clear = files::format_of(target) == files::Format::nifti && !geometry.oriented &&
                                  can_leave_sides_open(target, geometry);
  const bool is_whole = !has_codes_to_clear || clear_nifti_place(file->temporary_path());
  if (!is_whole || !verify(file->temporary_path(), geometry)) {
    return fail(ErrorKind::write, "{}: cannot write: the file is not whole (is the disk full?)", name);
  }
  return file->commit();
}

template <class T>
Status write_vector(const std::filesystem::path& file, const Geometry& geometry, itk::IOComponentEnum type,
                    const std::vector<T>& voxels) {
  return write_image(file, geometry, type, voxels.size(), voxels.data());
}

template <class T>
constexpr itk::IOComponentEnum kComponent = itk::ImageIOBase::MapPixelType<T>::CType;

template <class T>
bool holds(double low, double high) {
  return low >= std::numeric_limits<T>::min() && high <= std::numeric_limits<T>::max();
}

template <class To, class From>
std::vector<To> rescaled(const std::vector<From>& stored, double slope, double intercept) {
  std::vector<To> result(stored.size());
  for (std::size_t i = 0; i < stored.size(); ++i) {
    result[i] = static_cast<To>(slope * static_cast<double>(stored[i]) + intercept);
  }
  return result;
}

template <class T>
Status write_rescaled(const Volume& volume, const Geometry& grid, const std::vector<T>& stored,
                      const std::filesystem::path& file) {
  const double slope = volume.slope;
  const double intercept = volume.intercept;
  if (slope == 1.0 && intercept == 0.0) return write_vector(file, grid, kComponent<T>, stored);
  if (std::is_integral_v<T> && slope == std::floor(slope) && intercept == std::floor(intercept)) {
    const auto [low, high] = volume.range();
    if (holds<std::int16_t>(low, high)) {
      return write_vector(file, grid, kComponent<std::int16_t>,
                          rescaled<std::int16_t>(stored, slope, intercept));
    }
    if (holds<std::uint16_t>(low, high)) {
      return write_vector(file, grid, kComponent<std::uint16_t>,
                          rescaled<std::uint16_t>(stored, slope, intercept));
    }
  }
  return write_vector(file, grid, kComponent<float>, rescaled<float>(stored, slope, intercept));
}

}  // namespace

bool is_writable_volume_file(const std::filesystem::path& file) {
  return files::has_suffix(file, ".nii") || files::has_suffix(file, ".nii.gz") ||
         files::has_suffix(file, ".nrrd") || files::has_suffix(file, ".mha");
}

bool can_leave_sides_open(const std::filesystem::path& file, const Geometry& grid) {
  const auto format = files::format_of(file);
  return format == files::Format::nrrd ||
         (format == files::Format::nifti && grid.origin_mm == glm::dvec3(0.0) &&
          grid.direction == glm::dmat3(1.0));
}

Status write_volume_file(const Volume& volume, const std::filesystem::path& file, UnknownSides sides) {
  if (volume.geometry.voxel_count() <= 0) {
    return fail(ErrorKind::internal, "{}: the volume is empty", file.string());
  }
  Geometry grid = volume.geometry;
  if (sides == UnknownSides::stated) grid.oriented = true;
  try {
    return std::visit([&](const auto& stored) { return write_rescaled(volume, grid, stored, file); },
                      volume.voxels);
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::capability, "{}: not enough memory for {} rescaled voxels", file.string(),
                volume.geometry.voxel_count());
  }
}

Status write_mask_file(const Mask& mask, const std::filesystem::path& file) {
  return write_vector(file, mask.geometry, kComponent<std::uint8_t>, mask.voxels);
}

}  // namespace tidemark::imaging
