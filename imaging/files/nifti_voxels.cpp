#include "imaging/files/nifti_voxels.h"

#include <algorithm>
#include <string_view>
#include <type_traits>

namespace tidemark::imaging::files {
namespace {

template <class T>
void swap_bytes(std::vector<T>& voxels) {
  for (T& voxel : voxels) {
    auto* const bytes = reinterpret_cast<unsigned char*>(&voxel);
    std::reverse(bytes, bytes + sizeof(T));
  }
}

template <class To, class From>
std::vector<To> scaled(const std::vector<From>& stored, double slope, double intercept) {
  std::vector<To> result(stored.size());
  std::transform(stored.begin(), stored.end(), result.begin(),
                 [&](From value) { return static_cast<To>(slope * static_cast<double>(value) + intercept); });
  return result;
}

// Stored as Stored, read as To unless there is a scale, which makes floats.
template <class Stored, class To>
Result<Volume::Voxels> read_as(const PixelLayout& layout) {
  std::vector<Stored> stored(static_cast<std::size_t>(layout.voxels));
  TIDEMARK_TRY(read_stored(layout, stored.data()));
  if (layout.nifti->swapped) swap_bytes(stored);
  const double slope = layout.nifti->slope;
  const double intercept = layout.nifti->intercept;
  if (slope != 1.0 || intercept != 0.0) return scaled<float>(stored, slope, intercept);
  if constexpr (std::is_same_v<Stored, To>) {
    return stored;
  } else {
    return std::vector<To>(stored.begin(), stored.end());
  }
}

}  // namespace

NiftiType nifti_type(const NiftiVoxels& voxels) {
  NiftiType type;
  switch (voxels.datatype) {
    case 2:
      type = {"int16", "uint8", false};
      break;
    case 256:
      type = {"int16", "int8", false};
      break;
    case 4:
      type = {"int16", "int16", false};
      break;
    case 512:
      type = {"uint16", "uint16", false};
      break;
    case 8:
      type = {"float", "int32", true};
      break;
    case 768:
      type = {"float", "uint32", true};
      break;
    case 1024:
      type = {"float", "int64", true};
      break;
    case 1280:
      type = {"float", "uint64", true};
      break;
    case 64:
      type = {"float", "float64", true};
      break;
    default:
      break;
  }
  if (voxels.slope != 1.0 || voxels.intercept != 0.0) type.scalar = "float";
  return type;
}

Result<Volume::Voxels> read_nifti_voxels(const PixelLayout& layout) {
  switch (layout.nifti->datatype) {
    case 2:
      return read_as<std::uint8_t, std::int16_t>(layout);
    case 256:
      return read_as<std::int8_t, std::int16_t>(layout);
    case 4:
      return read_as<std::int16_t, std::int16_t>(layout);
    case 512:
      return read_as<std::uint16_t, std::uint16_t>(layout);
    case 8:
      return read_as<std::int32_t, float>(layout);
    case 768:
      return read_as<std::uint32_t, float>(layout);
    case 1024:
      return read_as<std::int64_t, float>(layout);
    case 1280:
      return read_as<std::uint64_t, float>(layout);
    case 64:
      return read_as<double, float>(layout);
    default:
      return read_as<float, float>(layout);
  }
}

}  // namespace tidemark::imaging::files
