#include "renderer/host/label_samples.h"

#include <algorithm>
#include <glm/common.hpp>

namespace tidemark::renderer {

LabelSamples::LabelSamples(const PageLayout& layout)
    : size_(layout.domain_size()), volume_(layout), colours_(first_label_colours()) {}

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

LabelSamples::Cell::Cell(const LabelSamples& samples, glm::vec3 position) {
  const glm::vec3 floor = glm::floor(position);
  const glm::ivec3 low(floor);
  far_share = position - floor;
  ends = {samples.clamped(low), samples.clamped(low + 1)};
  labels = samples.volume_.voxels().corners(ends[0], ends[1]);
}

bool LabelSamples::Cell::is_even() const {
  return std::all_of(labels.begin(), labels.end(), [this](std::uint8_t one) { return one == labels[0]; });
}

LabelSamples::Share LabelSamples::share_of(int label, const Cell& cell) const {
  const std::array<glm::vec3, 2> weights{1.0F - cell.far_share, cell.far_share};
  Share sum{0.0F, label};
  float most = 0.0F;
  const std::array<std::uint8_t, 8> shares = volume_.shares().corners(cell.ends[0], cell.ends[1]);
  for (std::size_t i = 0; i < cell.labels.size(); ++i) {
    const float weight = weights[i & 1].x * weights[i >> 1 & 1].y * weights[i >> 2].z;
    const int there = seen(cell.labels[i]);
    const float own = static_cast<float>(shares[i]) / 255.0F;
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
  const Index3 voxel = clamped(glm::ivec3(glm::floor(position + 0.5F)));
  const int nearest = seen(volume_.voxels().at(voxel));
  if (volume_.shares().at(voxel) == LabelVolume::kAll) return nearest;
  const Cell cell(*this, position);
  if (cell.is_even()) return nearest;
  const Share found = share_of(nearest, cell);
  return found.share >= 0.5F ? nearest : found.other;
}

glm::vec3 LabelSamples::slope(int label, glm::vec3 position) const {
  if (!volume_.has_voxels()) return glm::vec3(0.0F);
  glm::vec3 slope;
  for (int axis = 0; axis < 3; ++axis) {
    glm::vec3 h(0.0F);
    h[axis] = 1.0F;
    slope[axis] =
        share_of(label, Cell(*this, position + h)).share - share_of(label, Cell(*this, position - h)).share;
  }
  return slope;
}

}  // namespace tidemark::renderer
