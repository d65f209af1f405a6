#include "document/case_image.h"

#include <utility>

#include "imaging/resample.h"

namespace tidemark::document {

VoxelsOnGrid& VoxelsOnGrid::operator=(const VoxelsOnGrid& other) {
  if (this == &other) return *this;
  const std::lock_guard lock(mutex_);
  voxels_.reset();
  return *this;
}

Result<std::shared_ptr<const imaging::Resampled>> resampled(const CaseImage& image, const Geometry& grid) {
  if (image.volume == nullptr) return fail(ErrorKind::usage, "the image \"{}\" is missing", image.name);
  const VoxelsOnGrid& kept = image.voxels_on_grid;
  const std::lock_guard lock(kept.mutex_);
  if (kept.voxels_ == nullptr || !(kept.voxels_->volume.geometry == grid)) {
    auto voxels = imaging::resample(*image.volume, image.to_case, grid, image.name);
    if (!voxels) return pass_on(voxels);
    kept.voxels_ = std::make_shared<const imaging::Resampled>(std::move(*voxels));
  }
  return kept.voxels_;
}

Result<std::shared_ptr<const Volume>> on_grid(const CaseImage& image, const Geometry& grid) {
  const auto voxels = resampled(image, grid);
  if (!voxels) return pass_on(voxels);
  return std::shared_ptr<const Volume>(*voxels, &(*voxels)->volume);
}

}  // namespace tidemark::document
