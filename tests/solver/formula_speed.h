// A speed function from formulas, which counts the voxels that it is asked for.
#pragma once

#include <atomic>
#include <functional>

#include <glm/vec3.hpp>

#include "core/index_walk.h"
#include "solver/speed/cached_speed.h"

namespace tidemark::test {

class FormulaSpeed : public solver::SpeedFunction {
 public:
  // Of a voxel; D is quantised, so that every executor sees the same.
  using Speed = std::function<double(glm::dvec3 voxel)>;
  using Velocity = std::function<glm::vec3(glm::dvec3 voxel)>;

  explicit FormulaSpeed(Speed speed, Velocity velocity = nullptr, double fastest = 0.0)
      : speed_(std::move(speed)), velocity_(std::move(velocity)), fastest_(fastest) {}

  void evaluate(const solver::VoxelBox& box, double* speed) const override {
    evaluated_ += box.voxels();
    for_each_voxel(
        box, [&](glm::dvec3 voxel) { *speed++ = solver::speed_of(solver::quantised_speed(speed_(voxel))); });
  }
  [[nodiscard]] bool advects() const override { return velocity_ != nullptr; }
  void evaluate_advection(const solver::VoxelBox& box, glm::vec3* velocity) const override {
    for_each_voxel(box, [&](glm::dvec3 voxel) { *velocity++ = velocity_(voxel); });
  }
  [[nodiscard]] double fastest_advection() const override { return fastest_; }

  [[nodiscard]] std::int64_t evaluated() const { return evaluated_; }

 private:
  template <class Visit>
  static void for_each_voxel(const solver::VoxelBox& box, Visit visit) {
    for_each_index(box.first, box.first + box.size, [&](Index3 voxel) { visit(glm::dvec3(voxel)); });
  }

  Speed speed_;
  Velocity velocity_;
  double fastest_;
  mutable std::atomic<std::int64_t> evaluated_{0};
};

}  // namespace tidemark::test
