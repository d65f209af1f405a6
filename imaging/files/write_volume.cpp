#include <itkImageIORegion.h>

#include <cmath>
#include <limits>
#include <new>

#include "core/atomic_file.h"
#include "imaging/files/volume_file.h"
#include "imaging/files/volume_header.h"

namespace tidemark::imaging {
namespace {

constexpr std::int64_t kLongestNiftiAxis = std::numeric_limits<std::int16_t>::max();

void write_through_itk(const std::filesystem::path& file, const Geometry& geometry, itk::IOComponentEnum type,
                       const void* voxels) {
  const auto io = files::make_image_io(*files::format_of(file), file);
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
  if (!itk_name) return fail(ErrorKind::write, "{}", itk_name.error().message);
  try {
    write_through_itk(itk_name->path(), geometry, type, voxels);
  } catch (const std::exception& exception) {
    return fail(ErrorKind::write, "{}: cannot write: {}", name, files::one_line(exception));
  }
  if (const auto status = verify(file->temporary_path(), geometry); !status) {
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
Status write_rescaled(const Volume& volume, const std::vector<T>& stored, const std::filesystem::path& file) {
  const double slope = volume.slope;
  const double intercept = volume.intercept;
  if (slope == 1.0 && intercept == 0.0) return write_vector(file, volume.geometry, kComponent<T>, stored);
  if (std::is_integral_v<T> && slope == std::floor(slope) && intercept == std::floor(intercept)) {
    const auto [low, high] = volume.range();
    if (holds<std::int16_t>(low, high)) {
      return write_vector(file, volume.geometry, kComponent<std::int16_t>,
                          rescaled<std::int16_t>(stored, slope, intercept));
    }
    if (holds<std::uint16_t>(low, high)) {
      return write_vector(file, volume.geometry, kComponent<std::uint16_t>,
                          rescaled<std::uint16_t>(stored, slope, intercept));
    }
  }
  return write_vector(file, volume.geometry, kComponent<float>, rescaled<float>(stored, slope, intercept));
}

}  // namespace

bool is_writable_volume_file(const std::filesystem::path& file) {
  return files::has_suffix(file, ".nii") || files::has_suffix(file, ".nii.gz") ||
         files::has_suffix(file, ".nrrd") || files::has_suffix(file, ".mha");
}

Status write_volume_file(const Volume& volume, const std::filesystem::path& file) {
  if (volume.geometry.voxel_count() <= 0) {
    return fail(ErrorKind::internal, "{}: the volume is empty", file.string());
  }
  try {
    return std::visit([&](const auto& stored) { return write_rescaled(volume, stored, file); },
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
