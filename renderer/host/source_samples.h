// The source between voxels, as it lies in memory.
#pragma once

#include <algorithm>
#include <glm/vec3.hpp>
#include <memory>

#include "core/volume.h"

namespace tidemark::renderer {

class SourceSamples {
 public:
  enum class Stored { int16, uint16, float32 };

  explicit SourceSamples(std::shared_ptr<const Volume> source);

  [[nodiscard]] const Volume& volume() const { return *volume_; }
  [[nodiscard]] glm::ivec3 size() const { return size_; }

  // In the source's units, trilinear; voxel coordinates, integers at voxel centres. Beyond the volume as at
  // its border.
  [[nodiscard]] float between(glm::vec3 position) const;
  [[nodiscard]] float at(glm::ivec3 voxel) const;

  // For kernels: the stored voxels, x fastest; a value is slope * stored + intercept. A row is row_stride()
  // voxels long and has at least two, so that kernels can read pairs.
  [[nodiscard]] int row_stride() const { return std::max(size_.x, 2); }
  [[nodiscard]] Stored stored() const { return stored_; }
  [[nodiscard]] const void* voxels() const { return voxels_; }
  [[nodiscard]] float slope() const { return slope_; }
  [[nodiscard]] float intercept() const { return intercept_; }

 private:
  template <class T>
  [[nodiscard]] float between_stored(const T* voxels, glm::vec3 position) const;

  std::shared_ptr<const Volume> volume_;
  glm::ivec3 size_{0};
  Stored stored_ = Stored::int16;
  const void* voxels_ = nullptr;
  Volume::Voxels doubled_;  // of a volume that is one voxel wide, each twice
  float slope_ = 1.0F;
  float intercept_ = 0.0F;
};

// How long the part of a ray may be, in voxels, whose samples a kernel takes together: offsets within it fit
// 32 bits in a volume of that size.
float longest_together(glm::ivec3 size);

}  // namespace tidemark::renderer
