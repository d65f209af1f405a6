#include "solver/speed/examples/forest.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace tidemark::solver {

void ForestEvaluator::evaluate(const float* features, int feature_count, std::int64_t count, double* inside) {
  features_ = features;
  count_ = count;
  low_.resize(static_cast<std::size_t>(feature_count));
  high_.resize(static_cast<std::size_t>(feature_count));
  for (int f = 0; f < feature_count; ++f) {
    const float* values = features + f * count;
    float low = values[0];
    float high = values[0];
    bool numbers = !std::isnan(values[0]);
    for (std::int64_t i = 1; i < count; ++i) {
      low = values[i] < low ? values[i] : low;
      high = values[i] > high ? values[i] : high;
      numbers &= !std::isnan(values[i]);
    }
    low_[static_cast<std::size_t>(f)] = low;
    high_[static_cast<std::size_t>(f)] = numbers ? high : std::numeric_limits<float>::quiet_NaN();
  }
  if (samples_.empty()) samples_.emplace_back();
  samples_[0].resize(static_cast<std::size_t>(count));
  std::iota(samples_[0].begin(), samples_[0].end(), std::uint16_t{0});
  sums_.assign(static_cast<std::size_t>(count), 0);
  for (const std::int32_t root : forest_.roots) descend(root, 0, count, 0);

  const double unit = 1.0 / (static_cast<double>(kCertain) * static_cast<double>(forest_.roots.size()));
  for (std::int64_t i = 0; i < count; ++i) inside[i] = unit * sums_[static_cast<std::size_t>(i)];
}

// The samples [begin, end) of samples_[depth].
void ForestEvaluator::descend(std::int32_t index, std::int64_t begin, std::int64_t end, int depth) {
  const TreeNode* node = &forest_.nodes[static_cast<std::size_t>(index)];
  while (node->feature >= 0) {
    const auto feature = static_cast<std::size_t>(node->feature);
    if (high_[feature] <= node->threshold) {
      node = node + 1;
    } else if (low_[feature] > node->threshold) {
      node = &forest_.nodes[static_cast<std::size_t>(node->right)];
    } else {
      break;
    }
  }
  const std::uint16_t* samples = samples_[static_cast<std::size_t>(depth)].data();
  if (node->feature < 0) {
    for (std::int64_t i = begin; i < end; ++i) sums_[samples[i]] += node->inside;
    return;
  }
  const auto below = static_cast<std::size_t>(depth) + 1;
  if (samples_.size() == below) {
    samples_.emplace_back();
    samples = samples_[below - 1].data();
  }
  samples_[below].resize(static_cast<std::size_t>(count_));
  std::uint16_t* sorted = samples_[below].data();
  const float* values = features_ + node->feature * count_;
  // Those to the left from the front, those to the right from the back, without a branch a sample.
  std::int64_t left = begin;
  std::int64_t right = end - 1;
  for (std::int64_t i = begin; i < end; ++i) {
    const std::uint16_t sample = samples[i];
    const bool goes_right = !(values[sample] <= node->threshold);
    sorted[left] = sample;
    sorted[right] = goes_right ? sample : sorted[right];
    left += goes_right ? 0 : 1;
    right -= goes_right ? 1 : 0;
  }
  const auto child = static_cast<std::int32_t>(node - forest_.nodes.data());
  if (left > begin) descend(child + 1, begin, left, depth + 1);
  if (left < end) descend(node->right, left, end, depth + 1);
}

}  // namespace tidemark::solver
