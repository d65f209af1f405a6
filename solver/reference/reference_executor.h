// The reference executor, the truth in tests: dense, in double precision, with plain loops over the volume.
#pragma once

#include <memory>
#include <vector>

#include "solver/convergence.h"
#include "solver/executor_base.h"

namespace tidemark {

class ReferenceExecutor final : public ExecutorBase {
 public:
  ReferenceExecutor(std::shared_ptr<const Volume> source, const Parameters& parameters);

  [[nodiscard]] std::string_view name() const override { return "reference"; }
  Status restore(const Field& phi) override;
  [[nodiscard]] Result<Field> snapshot() const override;
  Status paint(const Sphere& sphere, Brush brush) override;
  Status set_parameters(const Parameters& parameters) override;
  Result<AdvanceReport> advance(const Advance& run) override;
  [[nodiscard]] MemoryReport memory() const override;
  [[nodiscard]] Result<std::vector<std::int64_t>> quiet_pages() const override { return {}; }
  [[nodiscard]] Status validate() const override;

  // phi in voxel order, in full precision.
  [[nodiscard]] const std::vector<double>& values() const { return phi_; }
  void set_values(std::vector<double> phi);

 private:
  template <bool kPaper>
  void step();
  void restart_window();

  std::vector<float> source_values_;
  std::vector<double> phi_;
  std::vector<double> previous_;  // of one step earlier
  std::vector<double> next_;
  SurfaceMotion motion_;  // of the window so far
  int steps_in_window_ = 0;
};

}  // namespace tidemark
