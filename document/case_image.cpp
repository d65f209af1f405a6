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

Result<std::shared_ptr<const Volume>> on_grid(const CaseImage& image, const Geometry& grid) {
  if (image.volume == nullptr) return fail(ErrorKind::usage, "the image \"{}\" is missing", image.name);
  const VoxelsOnGrid& kept = image.voxels_on_grid;
  const std::lock_guard lock(kept.mutex_);
  if (kept.voxels_ == nullptr || !(kept.voxels_->geometry == grid)) {
    auto resampled = imaging::resample(*image.volume, image.to_case, grid, image.name);
    if (!resampled) return pass_on(resampled);
    kept.voxels_ = std::make_shared<const Volume>(std::move(resampled->volume));
  }
  return kept.voxels_;
}

}  // namespace tidemark::document
