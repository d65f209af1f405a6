// The balance of the speed terms at a place: why the surface moves there, or rests.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/volume.h"
#include "solver/field.h"
#include "solver/model.h"
#include "solver/parameters.h"
#include "solver/speed/constraints.h"
#include "solver/speed/speed_function.h"

namespace tidemark::solver {

// The parts of dphi/dt, in smallest spacings per unit of time; > 0 moves the surface outward.
struct Pushes {
  double data = 0.0;
  double curvature = 0.0;
  double rescaling = 0.0;
  double advection = 0.0;
  double limits = 0.0;  // what walls, anchors and the ends of the band take from the others

  [[nodiscard]] double sum() const { return data + curvature + rescaling + advection + limits; }
  bool operator==(const Pushes&) const = default;
};

// All that the next step computes with.
struct StepInputs {
  std::shared_ptr<const Field> phi;
  std::shared_ptr<const Volume> source;  // on the grid of phi
  Parameters parameters;
  std::shared_ptr<const SpeedFunction> speed;      // null: the tent of the parameters
  std::shared_ptr<const Constraints> constraints;  // null: none
  double time_step = 0.0;                          // Executor::time_step()
  // Executor::moving_pages(), numbers of phi's layout; null: not known.
  std::shared_ptr<const std::vector<std::int64_t>> moving_pages = nullptr;

  bool operator==(const StepInputs&) const = default;
};

struct Balance {
  Pushes pushes;            // time_step * pushes.sum() is phi's change in the next step
  double phi = 0.0;         // in smallest spacings
  double intensity = 0.0;   // in the source's units
  double speed = 0.0;       // D
  glm::dvec3 outward{0.0};  // unit vector along the axes of the grid; 0 where phi is flat
};

// The step's terms at the eight voxels around a place, so that other parameters can be tried on them.
class PlaceBalance {
 public:
  // `place` in voxel coordinates, integers at centres; beyond the grid the nearest place in it counts.
  PlaceBalance(const StepInputs& inputs, glm::dvec3 place);
  ~PlaceBalance();
  PlaceBalance(const PlaceBalance&) = delete;
  PlaceBalance& operator=(const PlaceBalance&) = delete;

  // Interpolated trilinearly.
  [[nodiscard]] Balance balance() const;

  // The alpha, or the epsilon, nearest to the present one at which the pushes' sum is `sum`, all else being
  // equal. None where no value reaches it; for epsilon also where the speed is not the tent alone.
  [[nodiscard]] std::optional<double> alpha_for(double sum) const;
  [[nodiscard]] std::optional<double> range_for(double sum) const;

 private:
  struct Corner;
  [[nodiscard]] Pushes pushes_at(const Corner& corner, double speed,
                                 const StepConstants<double>& constants) const;
  // The pushes' sum with other parameters; D is the tent's where the speed is.
  [[nodiscard]] double sum_with(const Parameters& parameters) const;
  [[nodiscard]] bool is_tent() const { return inputs_.speed == nullptr; }

  StepInputs inputs_;
  std::vector<Corner> corners_;
};

// The place on the surface where the pushes' sum is largest by size, in voxel coordinates: in the pages that
// move, else on the whole surface, where a voxel that only flickers may win. The surface is looked at every
// smallest spacing and a half. None without a surface.
[[nodiscard]] std::optional<glm::dvec3> fastest_place(const StepInputs& inputs,
                                                      const std::stop_token& stop = {});

}  // namespace tidemark::solver
