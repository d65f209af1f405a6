// A volume's voxels by their type. Volume::value() would ask for the type at each of a hundred million.
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "core/volume.h"

namespace tidemark {

// The volume must outlive it.
template <class Stored>
struct TypedVolume {
  TypedVolume(const Volume& all, const std::vector<Stored>& voxels)
      : geometry(all.geometry), stored(voxels), slope(all.slope), intercept(all.intercept) {}

  // In rescaled units.
  [[nodiscard]] float rescaled(Stored voxel) const {
    return static_cast<float>(slope * static_cast<double>(voxel) + intercept);
  }
  [[nodiscard]] float value(std::int64_t offset) const {
    return rescaled(stored[static_cast<std::size_t>(offset)]);
  }
  [[nodiscard]] float value(Index3 voxel) const { return value(geometry.offset(voxel)); }

  const Geometry& geometry;
  const std::vector<Stored>& stored;
  double slope;
  double intercept;
};

// The result of work(typed), with the volume as a TypedVolume.
template <class Work>
auto with_type(const Volume& volume, const Work& work) {
  return std::visit([&](const auto& stored) { return work(TypedVolume(volume, stored)); }, volume.voxels);
}

}  // namespace tidemark
