#include "imaging/filters/separable_gaussian.h"

#include <algorithm>
#include <cmath>

namespace tidemark::imaging {
namespace {

// weights[d] for offsets +-d, together 1. Offsets beyond `farthest` act on the line's end values only, so
// they are gathered there.
std::vector<double> gaussian_weights(double sigma_voxels, std::int64_t farthest) {
  const auto reach = static_cast<std::int64_t>(std::min(std::ceil(5.0 * sigma_voxels), 1e6));
  std::vector<double> weights(static_cast<std::size_t>(std::min(reach, farthest)) + 1, 0.0);
  double sum = 0.0;
  for (std::int64_t d = 0; d <= reach; ++d) {
    const double x = static_cast<double>(d) / sigma_voxels;
    const double weight = std::exp(-0.5 * x * x);
    weights[static_cast<std::size_t>(std::min(d, static_cast<std::int64_t>(weights.size()) - 1))] += weight;
    sum += d == 0 ? weight : 2.0 * weight;
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

}  // namespace

void convolve_axis(std::vector<float>& values, Index3 size, int axis, double sigma_voxels) {
  const std::int64_t length = size[axis];
  const auto weights = gaussian_weights(sigma_voxels, length - 1);
  const auto reach = static_cast<std::int64_t>(weights.size()) - 1;
  if (reach == 0) return;
  const std::int64_t stride = axis == 0 ? 1 : axis == 1 ? size.x : size.x * size.y;
  std::vector<double> line(static_cast<std::size_t>(length + 2 * reach));  // with its ends continued
  const std::int64_t lines = size.x * size.y * size.z / length;
  for (std::int64_t n = 0; n < lines; ++n) {
    float* first = values.data() + n / stride * stride * length + n % stride;
    for (std::int64_t i = -reach; i < length + reach; ++i) {
      line[static_cast<std::size_t>(i + reach)] = first[std::clamp<std::int64_t>(i, 0, length - 1) * stride];
    }
    for (std::int64_t i = 0; i < length; ++i) {
      const double* centre = line.data() + i + reach;
      double sum = weights[0] * centre[0];
      for (std::int64_t d = 1; d <= reach; ++d) {
        sum += weights[static_cast<std::size_t>(d)] * (centre[-d] + centre[d]);
      }
      first[i * stride] = static_cast<float>(sum);
    }
  }
}

}  // namespace tidemark::imaging
