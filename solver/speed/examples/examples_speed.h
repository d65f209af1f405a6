// D = 2 p - 1, p the probability of "inside" as learned from strokes.
#pragma once

#include <memory>

#include "solver/speed/examples/features.h"
#include "solver/speed/examples/forest.h"
#include "solver/speed/speed_function.h"
#include "solver/speed/strokes.h"

namespace tidemark::solver {

struct TrainingOptions;

class ExamplesSpeed final : public SpeedFunction {
 public:
  // Of volumes on one grid, at least one. Fails (ErrorKind::usage) when strokes of one kind are missing or
  // leave the grid, or a volume has another size, (ErrorKind::cancelled).
  static Result<std::shared_ptr<const ExamplesSpeed>> train(
      std::vector<std::shared_ptr<const Volume>> volumes, const Strokes& strokes,
      const TrainingOptions& options, const Progress& progress);
  ExamplesSpeed(Features features, Forest forest)
      : features_(std::move(features)), forest_(std::move(forest)) {}

  void evaluate(const VoxelBox& box, double* speed) const override;
  [[nodiscard]] const Features& features() const { return features_; }
  [[nodiscard]] const Forest& forest() const { return forest_; }

 private:
  Features features_;
  Forest forest_;
};

}  // namespace tidemark::solver
