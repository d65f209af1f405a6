// The reference executor, the truth in tests: dense, in double precision, with plain loops over the volume.
#pragma once

#include <memory>
#include <vector>

#include "solver/executor_base.h"

namespace tidemark::solver {

class ReferenceExecutor final : public ExecutorBase {
 public:
  // It has no pages; where motion is judged page by page they have this shape.
  ReferenceExecutor(std::shared_ptr<const Volume> source, const Parameters& parameters,
                    Index3 page_shape = kDefaultPageShape);

  [[nodiscard]] std::string_view name() const override { return "reference"; }
  Status restore(const Field& phi) override;
  [[nodiscard]] Result<Field> snapshot() const override;
  Status paint(const Sphere& sphere, Brush brush) override;
  Status set_constraints(std::shared_ptr<const Constraints> constraints) override;
  Result<AdvanceReport> advance(const Advance& run) override;
  [[nodiscard]] MemoryReport memory() const override;
  [[nodiscard]] Result<std::vector<std::int64_t>> quiet_pages() const override { return {}; }
  [[nodiscard]] Result<std::vector<std::int64_t>> moving_pages() const override;
  [[nodiscard]] Status validate() const override;

  // phi in voxel order, in full precision.
  [[nodiscard]] const std::vector<double>& values() const { return phi_; }
  void set_values(std::vector<double> phi);

 private:
  template <bool kPaper>
  void step();
  void begin_window();
  void measure(Index3 voxel, double phi, double near);
  Status drive(const Parameters& parameters, std::shared_ptr<const SpeedFunction> given) override;
  void evaluate_speed();
  [[nodiscard]] double constrained(Index3 voxel, double phi) const;
  void constrain();
  [[nodiscard]] bool finish_window();

  PageLayout layout_;
  std::vector<double> speed_values_;  // D
  std::vector<glm::vec3> advection_;  // empty: there is none
  std::vector<double> phi_;
  std::vector<double> next_;
  // By page.
  std::vector<PageContent> contents_;  // of the window so far
  std::vector<PageRest> rests_;
};

}  // namespace tidemark::solver
