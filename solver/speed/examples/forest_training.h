// The training of a forest: extremely randomised trees (Geurts, Ernst and Wehenkel, Machine Learning 63,
// 2006).
#pragma once

#include <cstdint>
#include <vector>

#include "core/progress.h"
#include "solver/speed/examples/forest.h"

namespace tidemark::solver {

struct Samples {
  int features = 0;
  std::vector<float> values;         // feature f of sample i: values[f * count() + i]
  std::vector<std::uint8_t> inside;  // 1 or 0

  [[nodiscard]] std::int64_t count() const { return static_cast<std::int64_t>(inside.size()); }
};

struct TrainingOptions {
  int trees = 100;
  int depth = 12;
  int smallest_leaf = 3;     // samples; fewer where a class has not four times as many
  int tried_features = 0;    // a node; 0: the root of their number
  int tried_thresholds = 1;  // a feature
  std::uint64_t seed = 1;
  double doubt = 0.0;  // samples of either class that each leaf is given beforehand
};

// Both classes count alike, however many samples each has. The same samples give the same trees, for any
// number of threads. Fails (ErrorKind::cancelled).
Result<Forest> train(const Samples& samples, const TrainingOptions& options, const Progress& progress);

}  // namespace tidemark::solver
