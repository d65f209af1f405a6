// Balls: whether a surface is one, and the law by which the equation moves it.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "core/progress.h"
#include "solver/field.h"
#include "solver/parameters.h"

namespace tidemark::solver {

struct Ball {
  glm::dvec3 centre{0.0};  // voxel coordinates, integers at centres
  double radius_mm = 0.0;  // of the ball with the volume inside
};

// The ball that the surface is. Unset where some part of it is farther than `tolerance_mm` from the ball with
// its middle and its volume: another shape, several parts, or a ball that the volume's border cuts. Fails
// (ErrorKind::cancelled).
Result<std::optional<Ball>> ball_of(const Field& phi, double tolerance_mm, const Progress& progress = {});

[[nodiscard]] double radius_of_ball_mm(double volume_ml);
[[nodiscard]] double volume_of_ball_ml(double radius_mm);
[[nodiscard]] double area_of_ball_mm2(double radius_mm);

// How a ball's radius changes in tissue in which D is the same everywhere:
// dR/dt = growth - shrinking / R, with t in the equation's units of time, as Executor::time_step().
//
// dphi/dt = (alpha D + (1 - alpha) kappa) |grad phi|, with lengths in smallest spacings h and kappa the sum
// of both principal curvatures, -2 h / R on a ball. Rescaling does not move the surface.
struct BallLaw {
  double growth = 0.0;     // alpha D h, mm per unit of time; 0 without the data term
  double shrinking = 0.0;  // 2 (1 - alpha) h^2, mm^2 per unit of time; 0 without the curvature term

  // After so much time, mm: 0 once the ball has vanished.
  [[nodiscard]] double radius_after(double radius_mm, double time) const;
  // dR/dt, mm per unit of time.
  [[nodiscard]] double speed_at(double radius_mm) const { return growth - shrinking / radius_mm; }
  // The radius above which balls grow and below which they shrink; unset: all do one of both.
  [[nodiscard]] std::optional<double> critical_radius_mm() const;

  bool operator==(const BallLaw&) const = default;
};
[[nodiscard]] BallLaw ball_law(const Parameters& parameters, double data_speed, double smallest_spacing_mm);

}  // namespace tidemark::solver
