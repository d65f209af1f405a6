#include "renderer/host/label_samples.h"

#include <algorithm>
#include <glm/common.hpp>

namespace tidemark::renderer {

LabelSamples::LabelSamples(const solver::PageLayout& layout)
    : size_(layout.volume_size()), volume_(layout), colours_(first_label_colours()) {}

void LabelSamples::set_colours(std::span<const LabelColour> colours) {
  std::copy(colours.begin(), colours.end(), colours_.begin());
  volume_.set_colours(colours);
}

glm::vec3 LabelSamples::colour(int label) const {
  const LabelColour& colour = colours_[static_cast<std::size_t>(label)];
  return glm::vec3(colour[0], colour[1], colour[2]) / 255.0F;
}

float LabelSamples::opacity(int label) const {
  return static_cast<float>(colours_[static_cast<std::size_t>(label)][3]) / 255.0F;
}

Index3 LabelSamples::clamped(glm::ivec3 voxel) const {
  return glm::clamp(voxel, glm::ivec3(0), size_ - 1);
}

int LabelSamples::at(glm::ivec3 voxel) const {
  const int label = volume_.voxels().at(clamped(voxel));
  return pages().is_seen(label) ? label : 0;
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
    const float own = static_cast<float>(volume_.shares().at(clamped(low + corner))) / 255.0F;
    // Where two labels meet, what one has not is the other's.
    sum.share += weight * (there == label ? own : 1.0F - own);
    if (there == label) continue;
    if (weight > most) sum.other = there;
    most = std::max(most, weight);
  }
  return sum;
}

int LabelSamples::between(glm::vec3 position) const {
  if (!volume_.has_voxels()) return 0;
  const int nearest = at(glm::ivec3(glm::floor(position + 0.5F)));
  const Share found = share_of(nearest, position);
  return found.share >= 0.5F ? nearest : found.other;
}

glm::vec3 LabelSamples::slope(int label, glm::vec3 position) const {
  if (!volume_.has_voxels()) return glm::vec3(0.0F);
  glm::vec3 slope;
  for (int axis = 0; axis < 3; ++axis) {
    glm::vec3 h(0.0F);
    h[axis] = 1.0F;
    slope[axis] = share_of(label, position + h).share - share_of(label, position - h).share;
  }
  return slope;
}

}  // namespace tidemark::renderer
