#include "solver/speed/examples/forest_training.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/thread_pool.h"

namespace tidemark::solver {
namespace {

// SplitMix64 (Steele, Lea and Flood, 2014): the same numbers with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * 0x9E3779B97F4A7C15U) {}

  double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }  // in [0, 1)
  int below(int count) { return static_cast<int>(uniform() * count); }

 private:
  std::uint64_t next() {
    state_ += 0x9E3779B97F4A7C15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
};

struct Counts {
  std::int64_t outside = 0;
  std::int64_t inside = 0;

  [[nodiscard]] std::int64_t all() const { return outside + inside; }
};

struct Split {
  int feature = -1;
  float threshold = 0.0F;
  double impurity = 0.0;
};

class TreeBuilder {
 public:
  TreeBuilder(const Samples& samples, const TrainingOptions& options, std::uint64_t seed)
      : samples_(samples), options_(options), random_(seed), order_(samples.inside.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    const Counts all = count(0, samples.count());
    weight_[0] = 0.5 * static_cast<double>(all.all()) / static_cast<double>(all.outside);
    weight_[1] = 0.5 * static_cast<double>(all.all()) / static_cast<double>(all.inside);
    leaf_ = std::clamp<std::int64_t>(std::min(all.inside, all.outside) / 4, 1, options.smallest_leaf);
    tried_ = options.tried_features > 0
                 ? options.tried_features
                 : std::max(1, static_cast<int>(std::lround(std::sqrt(samples.features))));
  }

  std::vector<TreeNode> build() {
    grow(0, samples_.count(), 0);
    return std::move(nodes_);
  }

 private:
  [[nodiscard]] Counts count(std::int64_t begin, std::int64_t end) const {
    Counts counts;
    for (std::int64_t i = begin; i < end; ++i) counts.inside += samples_.inside[order_[index(i)]];
    counts.outside = end - begin - counts.inside;
    return counts;
  }

  // Gini's, times the weight of the samples.
  [[nodiscard]] double impurity(const Counts& counts) const {
    const double outside = weight_[0] * static_cast<double>(counts.outside);
    const double inside = weight_[1] * static_cast<double>(counts.inside);
    return outside * inside / (outside + inside);
  }

  void grow(std::int64_t begin, std::int64_t end, int depth) {
    const Counts counts = count(begin, end);
    const std::size_t node = nodes_.size();
    nodes_.emplace_back();
    Split split;
    if (counts.inside > 0 && counts.outside > 0 && depth < options_.depth && counts.all() >= 2 * leaf_) {
      split = best_split(begin, end, counts);
    }
    if (split.feature < 0) {
      const double outside = weight_[0] * static_cast<double>(counts.outside) + options_.doubt;
      const double inside = weight_[1] * static_cast<double>(counts.inside) + options_.doubt;
      nodes_[node].inside = static_cast<std::int32_t>(std::lround(kCertain * inside / (inside + outside)));
      return;
    }
    const float* values = feature(split.feature);
    const auto middle = std::partition(order_.begin() + begin, order_.begin() + end,
                                       [&](std::size_t i) { return values[i] <= split.threshold; });
    const std::int64_t right = middle - order_.begin();
    nodes_[node].feature = split.feature;
    nodes_[node].threshold = split.threshold;
    grow(begin, right, depth + 1);
    nodes_[node].right = static_cast<std::int32_t>(nodes_.size());
    grow(right, end, depth + 1);
  }

  Split best_split(std::int64_t begin, std::int64_t end, const Counts& all) {
    Split best;
    best.impurity = impurity(all);
    // Features that are the same in all samples do not count as tried.
    int tried = 0;
    for (int attempt = 0; attempt < 4 * tried_ && tried < tried_; ++attempt) {
      const int candidate = random_.below(samples_.features);
      const float* values = feature(candidate);
      float low = std::numeric_limits<float>::infinity();
      float high = -low;
      for (std::int64_t i = begin; i < end; ++i) {
        low = std::min(low, values[order_[index(i)]]);
        high = std::max(high, values[order_[index(i)]]);
      }
      if (!(low < high)) continue;
      ++tried;
      for (int n = 0; n < options_.tried_thresholds; ++n) {
        const auto threshold =
            static_cast<float>(low + random_.uniform() * (static_cast<double>(high) - low));
        consider({candidate, threshold, 0.0}, begin, end, all, best);
      }
    }
    return best;
  }

  void consider(Split split, std::int64_t begin, std::int64_t end, const Counts& all, Split& best) const {
    const float* values = feature(split.feature);
    Counts left;
    std::int64_t count = 0;
    for (std::int64_t i = begin; i < end; ++i) {
      const std::size_t sample = order_[index(i)];
      const bool below = values[sample] <= split.threshold;
      count += below ? 1 : 0;
      left.inside += below ? samples_.inside[sample] : 0;
    }
    left.outside = count - left.inside;
    const Counts right{all.outside - left.outside, all.inside - left.inside};
    if (left.all() < leaf_ || right.all() < leaf_) return;
    split.impurity = impurity(left) + impurity(right);
    if (split.impurity < best.impurity) best = split;
  }

  [[nodiscard]] const float* feature(int f) const { return samples_.values.data() + f * samples_.count(); }
  static std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }

  const Samples& samples_;
  const TrainingOptions& options_;
  Random random_;
  std::vector<std::size_t> order_;  // samples, those of a node side by side
  double weight_[2] = {1.0, 1.0};   // of a sample outside and inside
  int tried_ = 1;
  std::int64_t leaf_ = 1;  // samples, at least
  std::vector<TreeNode> nodes_;
};

}  // namespace

Result<Forest> train(const Samples& samples, const TrainingOptions& options, const Progress& progress) {
  std::vector<std::vector<TreeNode>> trees(static_cast<std::size_t>(options.trees));
  ThreadPool threads;
  threads.for_each(options.trees, 1, [&](std::int64_t first, std::int64_t last, int) {
    for (std::int64_t tree = first; tree < last && !progress.cancelled(); ++tree) {
      trees[static_cast<std::size_t>(tree)] =
          TreeBuilder(samples, options, static_cast<std::uint64_t>(tree) + options.seed * 100'000).build();
    }
  });
  if (progress.cancelled()) return cancelled_error();
  Forest forest;
  for (const auto& tree : trees) {
    const auto root = static_cast<std::int32_t>(forest.nodes.size());
    forest.roots.push_back(root);
    for (TreeNode node : tree) {
      if (node.feature >= 0) node.right += root;
      forest.nodes.push_back(node);
    }
  }
  return forest;
}

}  // namespace tidemark::solver
