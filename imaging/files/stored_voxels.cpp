#include "imaging/files/stored_voxels.h"

#include <algorithm>
#include <limits>
#include <type_traits>

#include "core/large_pages.h"
#include "imaging/guard/text_voxels.h"

namespace tidemark::imaging::files {
namespace {

template <class T>
void swap_bytes(std::vector<T>& voxels) {
  for (T& voxel : voxels) {
    auto* const bytes = reinterpret_cast<unsigned char*>(&voxel);
    std::reverse(bytes, bytes + sizeof(T));
  }
}

// The number of a text as the type that the header names.
template <class T>
Status convert(const PixelLayout& layout, std::int64_t voxel, double number, T& converted) {
  if constexpr (std::is_integral_v<T>) {
    if (number < static_cast<double>(std::numeric_limits<T>::min()) ||
        number >= static_cast<double>(std::numeric_limits<T>::max()) + 1.0) {
      return fail(ErrorKind::input, "{}: voxel {} is {}, which is no {}", layout.file.string(), voxel, number,
                  name_of(layout.scalar));
    }
  }
  converted = static_cast<T>(number);
  return {};
}

template <class T>
Result<std::vector<T>> read_stored_as(const PixelLayout& layout) {
  auto voxels = make_large_vector<T>(static_cast<std::size_t>(layout.voxels));
  if (layout.coding == Coding::text) {
    TIDEMARK_TRY(read_text(layout, [&](std::int64_t voxel, double number) {
      return convert(layout, voxel, number, voxels[static_cast<std::size_t>(voxel)]);
    }));
    return voxels;
  }
  TIDEMARK_TRY(read_stored(layout, voxels.data()));
  if (layout.swapped) swap_bytes(voxels);
  return voxels;
}

template <class To, class From>
std::vector<To> scaled(const std::vector<From>& stored, double slope, double intercept) {
  auto result = make_large_vector<To>(stored.size());
  std::transform(stored.begin(), stored.end(), result.begin(),
                 [&](From value) { return static_cast<To>(slope * static_cast<double>(value) + intercept); });
  return result;
}

bool is_scaled(const PixelLayout& layout) {
  return layout.slope != 1.0 || layout.intercept != 0.0;
}

// Stored as Stored, read as To unless there is a scale, which makes floats.
template <class Stored, class To>
Result<Volume::Voxels> read_as(const PixelLayout& layout) {
  auto stored = read_stored_as<Stored>(layout);
  if (!stored) return pass_on(stored);
  if (is_scaled(layout)) return scaled<float>(*stored, layout.slope, layout.intercept);
  if constexpr (std::is_same_v<Stored, To>) {
    return std::move(*stored);
  } else {
    auto voxels = make_large_vector<To>(stored->size());
    std::transform(stored->begin(), stored->end(), voxels.begin(),
                   [](Stored value) { return static_cast<To>(value); });
    return voxels;
  }
}

}  // namespace

VolumeType volume_type(const PixelLayout& layout) {
  VolumeType type;
  switch (layout.scalar) {
    case Scalar::int8:
    case Scalar::uint8:
    case Scalar::int16:
      type = {"int16", false};
      break;
    case Scalar::uint16:
      type = {"uint16", false};
      break;
    case Scalar::float32:
      break;
    default:
      type = {"float", true};
      break;
  }
  if (is_scaled(layout)) type.scalar = "float";
  return type;
}

Result<Volume::Voxels> read_stored_voxels(const PixelLayout& layout) {
  // Memory for a header that lies is taken only where it is little.
  constexpr std::int64_t kLittle = std::int64_t{32} << 20;  // bytes
  if (layout.bytes > kLittle) {
    TIDEMARK_TRY(check_stream(layout));
  }
  switch (layout.scalar) {
    case Scalar::int8:
      return read_as<std::int8_t, std::int16_t>(layout);
    case Scalar::uint8:
      return read_as<std::uint8_t, std::int16_t>(layout);
    case Scalar::int16:
      return read_as<std::int16_t, std::int16_t>(layout);
    case Scalar::uint16:
      return read_as<std::uint16_t, std::uint16_t>(layout);
    case Scalar::int32:
      return read_as<std::int32_t, float>(layout);
    case Scalar::uint32:
      return read_as<std::uint32_t, float>(layout);
    case Scalar::int64:
      return read_as<std::int64_t, float>(layout);
    case Scalar::uint64:
      return read_as<std::uint64_t, float>(layout);
    case Scalar::float32:
      return read_as<float, float>(layout);
    case Scalar::float64:
      return read_as<double, float>(layout);
  }
  return fail(ErrorKind::internal, "{}: unknown type of voxels", layout.file.string());
}

}  // namespace tidemark::imaging::files
