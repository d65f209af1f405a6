// A forest of decision trees: the share of "inside" among the samples that are like a voxel.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace tidemark::solver {

// Leaves hold the probability of "inside" in this unit, so that sums over trees are exact in any order.
inline constexpr std::int32_t kCertain = 1 << 16;

struct TreeNode {
  std::int32_t feature = -1;  // -1: a leaf
  float threshold = 0.0F;     // at or below it a sample goes left; what is no number goes right
  std::int32_t right = 0;     // in the tree's forest; the left one is the next node
  std::int32_t inside = 0;    // of a leaf: probability times kCertain
};

struct Forest {
  std::vector<TreeNode> nodes;
  std::vector<std::int32_t> roots;

  bool empty() const { return roots.empty(); }
};

// Writes the probabilities of `count` samples, at most 65,535: feature f of sample i is
// features[f * count + i].
//
// Voxels of a box are alike: at most nodes all of them go the same way. They therefore go through a tree
// together, and are looked at one by one only where a threshold lies between the least and the greatest.
class ForestEvaluator {
 public:
  explicit ForestEvaluator(const Forest& forest) : forest_(forest) {}
  // The probability of each sample.
  void evaluate(const float* features, int feature_count, std::int64_t count, double* inside);

 private:
  void descend(std::int32_t node, std::int64_t begin, std::int64_t end, int depth);

  const Forest& forest_;
  const float* features_ = nullptr;
  std::int64_t count_ = 0;
  std::vector<float> low_;  // of each feature
  std::vector<float> high_;
  std::vector<std::vector<std::uint16_t>> samples_;  // those in the node at each depth
  std::vector<std::int32_t> sums_;
};

}  // namespace tidemark::solver
