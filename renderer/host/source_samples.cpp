#include "renderer/host/source_samples.h"

#include <glm/common.hpp>
#include <limits>
#include <variant>

namespace tidemark::renderer {

SourceSamples::SourceSamples(std::shared_ptr<const Volume> source)
    : volume_(std::move(source)),
      size_(volume_->geometry.size),
      stored_(static_cast<Stored>(volume_->voxels.index())),
      slope_(static_cast<float>(volume_->slope)),
      intercept_(static_cast<float>(volume_->intercept)) {
  const Volume::Voxels* kept = &volume_->voxels;
  if (size_.x == 1) {
    std::visit(
        [&](const auto& voxels) {
          std::decay_t<decltype(voxels)> doubled;
          for (const auto voxel : voxels) doubled.insert(doubled.end(), 2, voxel);
          doubled_ = std::move(doubled);
        },
        volume_->voxels);
    kept = &doubled_;
  }
  std::visit([&](const auto& voxels) { voxels_ = voxels.data(); }, *kept);
}

template <class T>
float SourceSamples::between_stored(const T* voxels, glm::vec3 position) const {
  const glm::vec3 p = glm::clamp(position, glm::vec3(0.0F), glm::vec3(size_ - 1));
  const glm::ivec3 low = glm::min(glm::ivec3(p), glm::max(size_ - 2, glm::ivec3(0)));
  const glm::vec3 f = p - glm::vec3(low);
  const std::int64_t x = size_.x > 1 ? 1 : 0;
  const std::int64_t y = size_.y > 1 ? size_.x : 0;
  const std::int64_t z = size_.z > 1 ? std::int64_t{size_.x} * size_.y : 0;
  const T* first = voxels + low.x + size_.x * (low.y + std::int64_t{size_.y} * low.z);
  const auto row = [&](const T* at) {
    return glm::mix(static_cast<float>(at[0]), static_cast<float>(at[x]), f.x);
  };
  const float stored = glm::mix(glm::mix(row(first), row(first + y), f.y),
                                glm::mix(row(first + z), row(first + z + y), f.y), f.z);
  return slope_ * stored + intercept_;
}

float SourceSamples::between(glm::vec3 position) const {
  return std::visit([&](const auto& voxels) { return between_stored(voxels.data(), position); },
                    volume_->voxels);
}

float SourceSamples::at(glm::ivec3 voxel) const {
  return volume_->value(Index3(glm::clamp(voxel, glm::ivec3(0), size_ - 1)));
}

float longest_together(glm::ivec3 size) {
  constexpr std::int64_t kMost = 96;    // more gains nothing
  constexpr std::int64_t kBeside = 12;  // slices that the last sample, slopes and rounding add
  const std::int64_t slice = std::int64_t{std::max(size.x, 2)} * size.y;
  const std::int64_t slices = std::numeric_limits<std::int32_t>::max() / slice;
  return static_cast<float>(std::clamp(slices - kBeside, std::int64_t{0}, kMost));
}

}  // namespace tidemark::renderer
