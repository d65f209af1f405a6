// The level set on a GPU: pages are computed, allocated and freed by compute shaders.
#pragma once

#include <memory>

#include "gpu/device.h"
#include "gpu/program.h"
#include "solver/compute/page_memory.h"
#include "solver/gl/gl_executor.h"

namespace tidemark::solver {

// A step is two dispatches: update (new phi, and a code of what each page needs) and maintain (grants it).
// After every window of steps three more find out which pages are quiet. The processor hands over runs of
// steps and reads nothing in between; when a run ends early, because no page was free or the surface has
// stopped, the rest of its dispatches do nothing, and the counters say how far it came.
class ComputeExecutor final : public GlExecutor {
 public:
  // On options.device, else on a context of its own. Fails (ErrorKind::capability) without OpenGL 4.5.
  // $TIDEMARK_APRON (shared or columns) forces an address mode; by default hardware shares and software does
  // not.
  static Result<std::unique_ptr<Executor>> create(std::shared_ptr<const Volume> source,
                                                  const Parameters& parameters,
                                                  const ExecutorOptions& options);

  [[nodiscard]] std::string_view name() const override { return "compute"; }
  [[nodiscard]] Result<Field> snapshot() const override;
  Status paint(const Sphere& sphere, Brush brush) override;
  Result<AdvanceReport> advance(const Advance& run) override;
  [[nodiscard]] MemoryReport memory() const override;
  [[nodiscard]] Result<std::vector<std::int64_t>> quiet_pages() const override;
  [[nodiscard]] Result<std::vector<std::int64_t>> moving_pages() const override;
  bool packed_view(PackedView& view) override;
  [[nodiscard]] Status validate() const override;

 private:
  ComputeExecutor(std::shared_ptr<gpu::Device> device, std::shared_ptr<const Volume> source,
                  const Parameters& parameters, const ExecutorOptions& options);
  [[nodiscard]] bool software() const { return device_->capabilities().software; }
  [[nodiscard]] bool shared_apron() const;
  Status compile();
  Status compile_for_drive() override;
  Status compile_update();
  Status compile_paint();

  // Orders the dispatches of one step, which reads phi from buffer `now`.
  void order_step(int now, int step_in_window, bool in_pieces);
  void set_layout(const gpu::Program& program) const;
  void prepare_update(const gpu::Program& program);
  void order_update(const gpu::Program& program, int now);
  void prepare_maintenance(bool count_steps);
  void order_maintenance();
  void dispatch_update(bool in_pieces);
  void order_paging(int next, int step_in_window);
  void order_end_of_window(int now);
  void order_new_window(int now, bool judge_motion, bool wake_all);
  void begin_window(bool wake_all);
  Result<ComputeControl> run_steps(std::int64_t count, bool until_converged);

  // Grants every request of the present phi; G grows as needed.
  Status activate_pages(NoRoom no_room);
  // control_ is the present one.
  Status grow(std::int64_t more_pages);
  Status replace(const Field& phi) override;
  Status wake_all_pages() override;
  Result<std::int64_t> prepare_run(std::int64_t steps);
  void order_sphere(const Sphere& sphere, Brush brush, bool only_count);
  Status read_control();
  void note_memory();

  gpu::Defines update_defines_, paint_defines_;
  gpu::Program update_, measure_, maintain_, find_quiet_pages_, check_convergence_, rebuild_, paint_;
  PageMemory memory_;
  gpu::Readback readback_;

  int current_ = 0;                // the buffer that holds phi
  bool needs_activation_ = false;  // the budget stopped an allocation
  bool rests_ = false;             // as of the last full window
  std::int64_t steps_per_run_ = 1;
  double seconds_per_step_ = 0.0;  // as last measured
  struct {                         // of an advance, with ExecutorOptions::time_paging
    std::int64_t steps = 0;        // ordered
    double seconds = 0.0;          // of those that were timed
    double paging_seconds = 0.0;   // and for paging
  } paging_clock_;
  ComputeControl control_{};  // as last read
};

}  // namespace tidemark::solver
