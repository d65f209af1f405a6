#include "tests/app/speed_files.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "imaging/files/volume_file.h"

namespace tidemark::test {
namespace {

constexpr Index3 kTextures{44, 40, 36};
constexpr glm::dvec3 kCentre{21.0, 19.0, 17.0};
constexpr double kRadius = 12.0;

double depth(glm::dvec3 p) {
  return kRadius - glm::length(p - kCentre);
}

Mask mask_of(const Volume& volume, const std::function<bool(Index3)>& inside) {
  Mask mask{volume.geometry, {}};
  const Index3 size = volume.geometry.size;
  for (std::int64_t k = 0; k < size.z; ++k) {
    for (std::int64_t j = 0; j < size.y; ++j) {
      for (std::int64_t i = 0; i < size.x; ++i) mask.voxels.push_back(inside({i, j, k}) ? 1 : 0);
    }
  }
  return mask;
}

// Brush strokes in three slices, a little off the border.
double label(glm::dvec3 p) {
  if (p.z != 10.0 && p.z != 17.0 && p.z != 25.0) return 0.0;
  if (std::fmod(p.x, 6.0) > 2.0) return 0.0;
  if (depth(p) > 1.5) return 1.0;
  return depth(p) < -1.5 ? 2.0 : 0.0;
}

}  // namespace

Volume volume_of(Index3 size, double spacing_mm, const std::function<double(glm::dvec3)>& value) {
  Volume volume;
  volume.geometry.size = size;
  volume.geometry.spacing_mm = glm::dvec3(spacing_mm);
  std::vector<float> voxels;
  for (std::int64_t k = 0; k < size.z; ++k) {
    for (std::int64_t j = 0; j < size.y; ++j) {
      for (std::int64_t i = 0; i < size.x; ++i) {
        voxels.push_back(static_cast<float>(value(spacing_mm * glm::dvec3(i, j, k))));
      }
    }
  }
  volume.voxels = std::move(voxels);
  return volume;
}

double farthest_from(const Mask& from, const Mask& mask) {
  const auto voxels_of = [&](const Mask& of) {
    std::vector<glm::dvec3> voxels;
    for (std::int64_t v = 0; v < of.geometry.voxel_count(); ++v) {
      if (of.voxels[static_cast<std::size_t>(v)] != 0) voxels.emplace_back(of.geometry.voxel_at(v));
    }
    return voxels;
  };
  const std::vector<glm::dvec3> near = voxels_of(from);
  double farthest = 0.0;
  for (const glm::dvec3& voxel : voxels_of(mask)) {
    double distance = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& other : near) {
      distance = std::min(distance, glm::length(glm::max(glm::abs(voxel - other) - 0.5, 0.0)));
    }
    farthest = std::max(farthest, distance);
  }
  return farthest;
}

SpeedFiles::SpeedFiles() {
  const auto write = [&](const Volume& volume, const char* name) {
    if (!imaging::write_volume_file(volume, folder_ / name)) qFatal("%s cannot be written", name);
  };
  const auto write_mask = [&](const Mask& mask, const char* name) {
    if (!imaging::write_mask_file(mask, folder_ / name)) qFatal("%s cannot be written", name);
  };
  const Volume large = ball(Index3(30), 9.0);
  const Mask small = ball_mask(ball(Index3(30), 6.0));
  write(large, "ball.nrrd");
  write_mask(ball_mask(large), "large.nii.gz");
  write_mask(small, "small.nii.gz");
  write_mask(ball_mask(ball(Index3(30), 4.0)), "core.nii.gz");
  Volume map = large;
  std::vector<float> probabilities;
  for (const std::uint8_t inside : small.voxels) probabilities.push_back(inside != 0 ? 0.95F : 0.05F);
  map.voxels = std::move(probabilities);
  write(map, "map.nii.gz");
  write_mask(mask_of(large, [](Index3 v) { return v.x == 18 || v.x == 19; }), "walls.nii.gz");
  write_mask(mask_of(large, [](Index3 v) { return v.x < 4 && v.y > 12 && v.y < 18 && v.z > 12 && v.z < 18; }),
             "anchors.nii.gz");

  const Volume textures = volume_of(kTextures, 1.0, [](glm::dvec3 p) {
    const double wave = depth(p) > 0.0 ? 2.2 : 0.7;
    return 100.0 + 40.0 * std::sin(wave * p.x) * std::cos(wave * p.y + 0.3) * std::cos(wave * p.z);
  });
  write(textures, "textures.nii.gz");
  write_mask(mask_of(textures, [](Index3 v) { return depth(glm::dvec3(v)) > 0.0; }), "truth.nii.gz");
  write(volume_of(kTextures, 1.0, label), "labels.nii.gz");
  const auto shape = [](glm::dvec3 p) { return depth(p) > 0.0 ? 300.0 : 200.0; };
  write(volume_of({30, 27, 24}, 1.5, shape), "second.nrrd");
  write(volume_of({22, 20, 18}, 2.0, [](glm::dvec3 p) { return depth(p); }), "third.nrrd");
}

}  // namespace tidemark::test
