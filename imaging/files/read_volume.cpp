#include <itkImageIORegion.h>

#include <algorithm>
#include <new>

#include "imaging/files/nifti_voxels.h"
#include "imaging/files/volume_file.h"
#include "imaging/files/volume_header.h"

namespace tidemark::imaging {
namespace {

using files::VolumeHeader;

// All voxels in ITK's type.
template <class T>
std::vector<T> read_as(const VolumeHeader& header) {
  itk::ImageIORegion region(header.io->GetNumberOfDimensions());
  for (unsigned axis = 0; axis < header.io->GetNumberOfDimensions(); ++axis) {
    region.SetIndex(axis, 0);
    region.SetSize(axis, header.io->GetDimensions(axis));
  }
  header.io->SetIORegion(region);
  std::vector<T> voxels(static_cast<std::size_t>(header.geometry.voxel_count()));
  header.io->Read(voxels.data());
  return voxels;
}

template <class To, class From>
std::vector<To> converted(const std::vector<From>& voxels) {
  std::vector<To> result(voxels.size());
  std::transform(voxels.begin(), voxels.end(), result.begin(), [](From v) { return static_cast<To>(v); });
  return result;
}

Result<Volume::Voxels> read_voxels(const VolumeHeader& header) {
  if (header.layout.nifti) return files::read_nifti_voxels(header.layout);
  TIDEMARK_TRY(files::check_stream(header.layout));
  using Type = itk::IOComponentEnum;
  switch (header.io->GetComponentType()) {
    case Type::UCHAR:
      return converted<std::int16_t>(read_as<unsigned char>(header));
    case Type::CHAR:
      return converted<std::int16_t>(read_as<signed char>(header));
    case Type::SHORT:
      return read_as<std::int16_t>(header);
    case Type::USHORT:
      return read_as<std::uint16_t>(header);
    case Type::UINT:
      return converted<float>(read_as<unsigned int>(header));
    case Type::INT:
      return converted<float>(read_as<int>(header));
    case Type::ULONG:
      return converted<float>(read_as<unsigned long>(header));
    case Type::LONG:
      return converted<float>(read_as<long>(header));
    case Type::ULONGLONG:
      return converted<float>(read_as<unsigned long long>(header));
    case Type::LONGLONG:
      return converted<float>(read_as<long long>(header));
    case Type::DOUBLE:
      return converted<float>(read_as<double>(header));
    default:
      return read_as<float>(header);
  }
}

}  // namespace

bool is_readable_volume_file(const std::filesystem::path& file) {
  return files::format_of(file).has_value();
}

Result<Series> scan_volume_file(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) {
    return fail(ErrorKind::input, "{}: no such file", file.string());
  }
  const files::ItkScope scope;
  Series series;
  series.uid = file.filename().string();
  series.description = series.uid;
  series.files = {file};
  auto header = files::check_header(file);
  if (!header) {
    series.reason = std::move(header.error().message);
    return series;
  }
  series.loadable = true;
  series.geometry = header->geometry;
  series.scalar = header->scalar;
  series.changes = std::move(header->changes);
  series.warnings = std::move(header->warnings);
  return series;
}

Result<Volume> read_volume_file(const std::filesystem::path& file, const Progress& progress) {
  const std::string name = file.string();
  const files::ItkScope scope;
  progress(0.0, "reading the volume");
  if (progress.cancelled()) return cancelled_error();
  auto header = files::check_header(file);
  if (!header) return pass_on(header);
  progress(0.1, "reading the volume");
  if (progress.cancelled()) return cancelled_error();

  Volume volume;
  try {
    auto voxels = read_voxels(*header);
    if (!voxels) return pass_on(voxels);
    volume.voxels = std::move(*voxels);
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::capability, "{}: not enough memory for {} voxels", name,
                header->geometry.voxel_count());
  } catch (const std::exception& exception) {
    return fail(ErrorKind::input, "{}: the voxels cannot be read: {}", name, files::one_line(exception));
  }
  if (progress.cancelled()) return cancelled_error();
  volume.geometry = header->geometry;
  volume.description = file.filename().string();
  volume.changes = std::move(header->changes);
  volume.changes.insert(volume.changes.end(), header->warnings.begin(), header->warnings.end());
  TIDEMARK_TRY(require_finite(volume, name));
  progress(1.0, "reading the volume");
  return volume;
}

}  // namespace tidemark::imaging
