// D = sharpness (2 p - 1), at most 1: p is the probability of "inside". A forest learns from strokes what
// belongs to the object, and a random walker spreads the strokes as far as no edge is in between.
#pragma once

#include <memory>

#include "solver/speed/examples/features.h"
#include "solver/speed/examples/forest.h"
#include "solver/speed/examples/forest_training.h"
#include "solver/speed/examples/random_walker.h"
#include "solver/speed/speed_function.h"
#include "solver/speed/strokes.h"

namespace tidemark::solver {

struct ExamplesOptions {
  double sharpness = 2.0;
  TrainingOptions training;
  WalkerOptions walker;
};

class ExamplesSpeed final : public SpeedFunction {
 public:
  // Of volumes on one grid, at least one. Fails (ErrorKind::usage) when strokes of one kind are missing or
  // leave the grid, or a volume has another size, (ErrorKind::cancelled).
  static Result<std::shared_ptr<const ExamplesSpeed>> train(
      std::vector<std::shared_ptr<const Volume>> volumes, const Strokes& strokes,
      const ExamplesOptions& options, const Progress& progress);
  ExamplesSpeed(Features features, Forest forest, RandomWalker walker, const ExamplesOptions& options)
      : features_(std::move(features)),
        forest_(std::move(forest)),
        walker_(std::move(walker)),
        options_(options) {}

  void evaluate(const VoxelBox& box, double* speed) const override;
  [[nodiscard]] bool has_doubt() const override { return true; }
  void evaluate_doubt(const VoxelBox& box, double* doubt) const override;
  [[nodiscard]] const Features& features() const { return features_; }
  [[nodiscard]] const Forest& forest() const { return forest_; }

 private:
  void probabilities(const VoxelBox& box, double* inside) const;

  Features features_;
  Forest forest_;
  RandomWalker walker_;
  ExamplesOptions options_;
};

}  // namespace tidemark::solver
