#include "imaging/files/volume_header.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/checked.h"
#include "imaging/files/stored_voxels.h"

namespace tidemark::imaging::files {
namespace {

// Sines of angles and errors of length up to this are taken for rounding in the header.
constexpr double kAxisTolerance = 1e-3;

Result<Index3> checked_size(const itk::ImageIOBase& io, const std::string& name) {
  const unsigned dimensions = io.GetNumberOfDimensions();
  if (dimensions < 3) {
    return fail(ErrorKind::input, "{}: the image has {} dimensions, a volume has 3", name, dimensions);
  }
  for (unsigned axis = 3; axis < dimensions; ++axis) {
    if (io.GetDimensions(axis) != 1) {
      return fail(ErrorKind::input, "{}: dimension {} has {} entries: more than one volume", name, axis + 1,
                  io.GetDimensions(axis));
    }
  }
  Index3 size;
  for (unsigned axis = 0; axis < 3; ++axis)
    size[static_cast<int>(axis)] = static_cast<std::int64_t>(io.GetDimensions(axis));
  const auto voxels = checked_product(size.x, size.y, size.z);
  if (!voxels || *voxels == 0) {
    return fail(ErrorKind::input, "{}: size {} x {} x {} makes no volume", name, size.x, size.y, size.z);
  }
  return size;
}

// The nearest right-angled axes by Gram-Schmidt, when they are within the tolerance of right angles.
Result<glm::dmat3> checked_direction(const glm::dmat3& stated, const std::string& name) {
  double worst = 0.0;
  for (int a = 0; a < 3; ++a) {
    for (int b = a; b < 3; ++b) {
      const double error = std::abs(glm::dot(stated[a], stated[b]) - (a == b ? 1.0 : 0.0));
      worst = std::isfinite(error) ? std::max(worst, error) : 1.0;
    }
  }
  if (worst > kAxisTolerance) {
    return fail(ErrorKind::input, "{}: direction: the axes are not at right angles (off by {:.3g})", name,
                worst);
  }
  if (worst < 1e-12) return stated;
  glm::dmat3 direction;
  direction[0] = glm::normalize(stated[0]);
  direction[1] = glm::normalize(stated[1] - glm::dot(stated[1], direction[0]) * direction[0]);
  direction[2] = glm::cross(direction[0], direction[1]);
  if (glm::dot(direction[2], stated[2]) < 0.0) direction[2] = -direction[2];  // left-handed axes stay so
  return direction;
}

// Whether ITK gives the origin as the header has it.
bool is_origin_unscaled(const itk::ImageIOBase& io, const PixelLayout& layout) {
  constexpr double kRounding = 1e-6;
  const glm::dvec3 given(io.GetOrigin(0), io.GetOrigin(1), io.GetOrigin(2));
  const auto is_given = [&](const glm::dvec3& origin) {
    return glm::distance(given, origin) <= kRounding * glm::length(origin);
  };
  return layout.origins.empty() || std::any_of(layout.origins.begin(), layout.origins.end(), is_given);
}

Result<Geometry> checked_geometry(const itk::ImageIOBase& io, const PixelLayout& layout,
                                  const std::string& name) {
  Geometry geometry;
  const auto size = checked_size(io, name);
  if (!size) return pass_on(size);
  geometry.size = *size;
  geometry.oriented = layout.oriented;
  const double origin_scale = is_origin_unscaled(io, layout) ? layout.origin_scale : 1.0;
  glm::dmat3 direction;
  for (unsigned axis = 0; axis < 3; ++axis) {
    const int a = static_cast<int>(axis);
    geometry.spacing_mm[a] = layout.spacing_scale * io.GetSpacing(axis);
    if (!std::isfinite(geometry.spacing_mm[a]) || geometry.spacing_mm[a] <= 0.0) {
      return fail(ErrorKind::input, "{}: spacing along axis {} is {} mm", name, axis, geometry.spacing_mm[a]);
    }
    geometry.origin_mm[a] = origin_scale * io.GetOrigin(axis) + 0.0;  // never "-0"
    if (!std::isfinite(geometry.origin_mm[a])) {
      return fail(ErrorKind::input, "{}: origin along axis {} is {} mm", name, axis, geometry.origin_mm[a]);
    }
    const std::vector<double> column = io.GetDirection(axis);
    direction[a] = glm::dvec3(column.at(0), column.at(1), column.at(2));
  }
  auto right_angled = checked_direction(direction, name);
  if (!right_angled) return pass_on(right_angled);
  geometry.direction = *right_angled;
  return geometry;
}

Status require_single_numbers(const itk::ImageIOBase& io, const std::string& name) {
  if (io.GetNumberOfComponents() == 1 && io.GetPixelType() == itk::IOPixelEnum::SCALAR) return {};
  return fail(ErrorKind::input, "{}: {} values of type {} per voxel: only single numbers make a volume", name,
              io.GetNumberOfComponents(), itk::ImageIOBase::GetPixelTypeAsString(io.GetPixelType()));
}

}  // namespace

Result<VolumeHeader> check_header(const std::filesystem::path& file) {
  const std::string name = file.string();
  auto layout = locate_pixels(file);
  if (!layout) return pass_on(layout);
  TIDEMARK_TRY(check_extent(*layout));

  const Format format = *format_of(file);
  auto name_for_itk = ItkName::create(format, file, ItkName::Use::read);
  if (!name_for_itk) return pass_on(name_for_itk);
  VolumeHeader header{.layout = std::move(*layout)};
  try {
    const auto io = make_image_io(format, name_for_itk->path());
    io->ReadImageInformation();
    auto geometry = checked_geometry(*io, header.layout, name);
    if (!geometry) return pass_on(geometry);
    header.geometry = *geometry;
    TIDEMARK_TRY(require_single_numbers(*io, name));
  } catch (const std::exception& exception) {
    return fail(ErrorKind::input, "{}: the header cannot be read: {}", name, one_line(exception));
  }
  if (header.geometry.voxel_count() != header.layout.voxels) {
    return fail(ErrorKind::input, "{}: the header says {} voxels, ITK reads {}", name, header.layout.voxels,
                header.geometry.voxel_count());
  }
  const VolumeType type = volume_type(header.layout);
  header.scalar = type.scalar;
  if (type.converted) {
    header.changes.push_back(fmt::format("{} values converted to float", name_of(header.layout.scalar)));
  }
  header.warnings = header.layout.warnings;
  if (!header.layout.oriented) {
    header.warnings.emplace_back("the file does not say how its axes lie in the patient");
  }
  return header;
}

}  // namespace tidemark::imaging::files
