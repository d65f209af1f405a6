// Small volumes and raw headers for the tests of volume files.
#pragma once

#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <glm/matrix.hpp>
#include <iterator>
#include <string>

#include "core/volume.h"

namespace tidemark::test {

// Oblique, anisotropic and left-handed, far from the origin: what a format may get wrong shows here.
inline Geometry awkward_grid(Index3 size = {7, 5, 3}) {
  const double a = 0.3;
  const double b = -0.7;
  const glm::dmat3 turn_z(std::cos(a), std::sin(a), 0, -std::sin(a), std::cos(a), 0, 0, 0, 1);
  const glm::dmat3 turn_x(1, 0, 0, 0, std::cos(b), std::sin(b), 0, -std::sin(b), std::cos(b));
  Geometry geometry;
  geometry.size = size;
  geometry.spacing_mm = {0.7312, 0.9011, 3.2501};
  geometry.direction = turn_z * turn_x;
  geometry.direction[2] = -geometry.direction[2];
  geometry.origin_mm = {-123.4567, 87.6543, -310.2468};
  return geometry;
}

template <class T>
Volume counting_volume(const Geometry& geometry, T first) {
  Volume volume;
  volume.geometry = geometry;
  std::vector<T> voxels(static_cast<std::size_t>(geometry.voxel_count()));
  for (std::size_t i = 0; i < voxels.size(); ++i) voxels[i] = static_cast<T>(first + static_cast<T>(i));
  volume.voxels = std::move(voxels);
  return volume;
}

inline std::string contents(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline void put(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

// The 352 bytes in front of a NIfTI-1 file's voxels. Offsets are nifti1.h's.
class NiftiHeader {
 public:
  NiftiHeader(std::array<std::int16_t, 3> size, std::int16_t datatype, std::int16_t bits) {
    set<std::int32_t>(0, 348);
    set<std::int16_t>(40, 3);
    for (std::size_t i = 0; i < 3; ++i) set<std::int16_t>(42 + 2 * i, size[i]);
    for (std::size_t i = 3; i < 7; ++i) set<std::int16_t>(42 + 2 * i, 1);
    set<std::int16_t>(70, datatype);
    set<std::int16_t>(72, bits);
    for (std::size_t i = 0; i < 4; ++i) set<float>(76 + 4 * i, 1.0F);
    set<float>(108, 352.0F);
    set<std::int16_t>(254, 1);  // sform_code
    for (std::size_t row = 0; row < 3; ++row) set<float>(280 + 20 * row, 1.0F);
    std::memcpy(bytes_.data() + 344, "n+1", 4);
  }

  template <class T>
  NiftiHeader& set(std::size_t offset, T value) {
    std::memcpy(bytes_.data() + offset, &value, sizeof(T));
    return *this;
  }

  [[nodiscard]] std::string bytes() const { return bytes_; }

  // The file in the other byte order; `voxels` must be swapped by the caller.
  [[nodiscard]] std::string swapped() const {
    std::string result = bytes_;
    const auto swap = [&](std::size_t offset, std::size_t count) {
      std::reverse(result.begin() + static_cast<std::ptrdiff_t>(offset),
                   result.begin() + static_cast<std::ptrdiff_t>(offset + count));
    };
    swap(0, 4);
    for (std::size_t i = 0; i < 8; ++i) swap(40 + 2 * i, 2);
    for (const std::size_t offset : {70, 72, 252, 254}) swap(offset, 2);
    for (std::size_t i = 0; i < 8; ++i) swap(76 + 4 * i, 4);
    for (const std::size_t offset : {108, 112, 116}) swap(offset, 4);
    for (std::size_t i = 0; i < 18; ++i) swap(256 + 4 * i, 4);
    return result;
  }

 private:
  std::string bytes_ = std::string(352, '\0');
};

}  // namespace tidemark::test
