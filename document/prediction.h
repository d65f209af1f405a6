// The prediction of a surface that is a ball, where mathematics has a law for it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/progress.h"
#include "solver/balance.h"
#include "solver/ball.h"

namespace tidemark::document {

struct PredictedPoint {
  std::int64_t step = 0;
  double radius_mm = 0.0;  // 0: it has vanished

  bool operator==(const PredictedPoint&) const = default;
};

// What becomes of a ball from a step on, as long as nothing is steered.
struct Prediction {
  // Why there is none.
  enum class Obstacle {
    none,     // there is one
    shape,    // the surface is no ball, or smaller than the grid can show
    speed,    // D is not the same all around the surface
    held,     // walls, anchors or a limit hold it there
    follows,  // D follows the surface, or carries it along
  };
  // Why it ends.
  enum class End {
    horizon,   // kFarthest steps
    vanishes,  // the radius is 0
    tissue,    // D is another one from there on, or something holds the surface
    border,    // the volume ends
  };
  static constexpr std::int64_t kFarthest = 20000;  // steps
  static constexpr std::size_t kMostPoints = 400;

  Obstacle obstacle = Obstacle::none;
  solver::BallLaw law;
  double data_speed = 0.0;  // D around the surface; 0 where it does not count
  End end = End::horizon;
  std::vector<PredictedPoint> points;  // from the present one to the end, by growing step

  [[nodiscard]] bool holds() const { return obstacle == Obstacle::none; }
  // Between the points, interpolated; unset beyond them.
  [[nodiscard]] std::optional<double> radius_at(std::int64_t step) const;
};

// How far D may be from its mean around the surface, root mean square, to count as the same.
inline constexpr double kEvenSpeed = 0.05;

// Of the surface at that step. Takes the time to look at D where the ball will come. Fails
// (ErrorKind::cancelled).
Result<Prediction> predict(const solver::StepInputs& inputs, std::int64_t step,
                           const Progress& progress = {});

}  // namespace tidemark::document
