// Several speed functions joined into one.
#pragma once

#include <memory>
#include <vector>

#include "solver/parameters.h"
#include "solver/speed/speed_function.h"
#include "solver/speed/speed_setting.h"

namespace tidemark::solver {

// D is the least of theirs or their product (Combine); v is the sum of theirs. The doubt is that of the
// function that is least sure.
class CombinedSpeed final : public SpeedFunction {
 public:
  // At least one function, with D in [-1, 1].
  CombinedSpeed(std::vector<std::shared_ptr<const SpeedFunction>> functions, Combine combine);

  void evaluate(const VoxelBox& box, double* speed) const override {
    join(&SpeedFunction::evaluate, box, speed);
  }
  void evaluate_once(const VoxelBox& box, double* speed) const override {
    join(&SpeedFunction::evaluate_once, box, speed);
  }

  [[nodiscard]] bool advects() const override;
  void evaluate_advection(const VoxelBox& box, glm::vec3* velocity) const override;
  [[nodiscard]] double fastest_advection() const override;

  [[nodiscard]] bool has_doubt() const override;
  void evaluate_doubt(const VoxelBox& box, double* doubt) const override;

  // Those that follow the surface follow it; the others stay, with what they have cached.
  [[nodiscard]] bool follows_surface() const override;
  [[nodiscard]] std::shared_ptr<const SpeedFunction> following(const Field& phi) const override;

  // The same with its tents on that source, for other parameters.
  [[nodiscard]] std::shared_ptr<const CombinedSpeed> with_tents(const std::shared_ptr<const Volume>& source,
                                                                const Parameters& parameters) const;

 private:
  // The D of all functions by that method.
  using Evaluate = void (SpeedFunction::*)(const VoxelBox&, double*) const;
  void join(Evaluate method, const VoxelBox& box, double* speed) const;

  std::vector<std::shared_ptr<const SpeedFunction>> functions_;
  Combine combine_;
};

}  // namespace tidemark::solver
