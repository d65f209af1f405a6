#include "renderer/host/label_samples.h"

#include <algorithm>
#include <glm/common.hpp>

#include "renderer/label_share.h"

namespace tidemark::renderer {

LabelSamples::LabelSamples(const solver::PageLayout& layout)
    : layout_(layout), size_(layout.volume_size()), pages_(layout), colours_(first_label_colours()) {}

void LabelSamples::set_voxels(std::span<const std::uint8_t> voxels) {
  voxels_.assign(voxels.begin(), voxels.end());
  shares_.clear();
  pages_.set_voxels(voxels);
}

void LabelSamples::set_colours(std::span<const LabelColour> colours) {
  std::copy(colours.begin(), colours.end(), colours_.begin());
  pages_.set_colours(colours);
}

void LabelSamples::prepare_borders() {
  if (voxels_.empty() || !shares_.empty()) return;
  shares_ = label_shares(layout_, voxels_, pages_.mixed());
}

glm::vec3 LabelSamples::colour(int label) const {
  const LabelColour& colour = colours_[static_cast<std::size_t>(label)];
  return glm::vec3(colour[0], colour[1], colour[2]) / 255.0F;
}

float LabelSamples::opacity(int label) const {
  return static_cast<float>(colours_[static_cast<std::size_t>(label)][3]) / 255.0F;
}

std::size_t LabelSamples::offset_of(glm::ivec3 voxel) const {
  const glm::ivec3 v = glm::clamp(voxel, glm::ivec3(0), size_ - 1);
  return static_cast<std::size_t>(v.x + size_.x * (v.y + std::int64_t{size_.y} * v.z));
}

int LabelSamples::at(glm::ivec3 voxel) const {
  if (voxels_.empty()) return 0;
  const int label = voxels_[offset_of(voxel)];
  return pages_.is_seen(label) ? label : 0;
}

LabelSamples::Share LabelSamples::share_of(int label, glm::vec3 position) const {
  const glm::vec3 floor = glm::floor(position);
  const glm::ivec3 low(floor);
  const glm::vec3 f = position - floor;
  Share sum{0.0F, label};
  float most = 0.0F;
  for (int i = 0; i < 8; ++i) {
    const glm::ivec3 corner(i & 1, i >> 1 & 1, i >> 2);
    const glm::vec3 along = glm::mix(1.0F - f, f, glm::vec3(corner));
    const float weight = along.x * along.y * along.z;
    const int there = at(low + corner);
    const float own = static_cast<float>(shares_[offset_of(low + corner)]) / 255.0F;
    // Where two labels meet, what one has not is the other's.
    sum.share += weight * (there == label ? own : 1.0F - own);
    if (there == label) continue;
    if (weight > most) sum.other = there;
    most = std::max(most, weight);
  }
  return sum;
}

int LabelSamples::between(glm::vec3 position) const {
  if (voxels_.empty()) return 0;
  const int nearest = at(glm::ivec3(glm::floor(position + 0.5F)));
  const Share found = share_of(nearest, position);
  return found.share >= 0.5F ? nearest : found.other;
}

glm::vec3 LabelSamples::slope(int label, glm::vec3 position) const {
  if (voxels_.empty()) return glm::vec3(0.0F);
  glm::vec3 slope;
  for (int axis = 0; axis < 3; ++axis) {
    glm::vec3 h(0.0F);
    h[axis] = 1.0F;
    slope[axis] = share_of(label, position + h).share - share_of(label, position - h).share;
  }
  return slope;
}

}  // namespace tidemark::renderer
