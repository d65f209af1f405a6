// The level set on the processor: pages of 8^3 voxels, vectorised, shared among threads.
#pragma once

#include <memory>
#include <vector>

#include "core/thread_pool.h"
#include "solver/executor_base.h"
#include "solver/host/page_edits.h"
#include "solver/host/page_kernel.h"
#include "solver/host/quiet_pages.h"
#include "solver/host/resident_pages.h"

namespace tidemark::solver {

// A step reads phi from one buffer and writes it to the other (Jacobi), so its result does not depend on the
// order of pages: the same bits for any number of threads. Between steps pages are allocated and freed from
// the codes that the pages wrote.
class HostExecutor final : public ExecutorBase {
 public:
  // The kernels of the widest instruction set, or of the one that $TIDEMARK_SIMD names. Fails as
  // select_page_kernels() does, naming the variable.
  static Result<PageKernels> chosen_kernels();

  // With the chosen kernels.
  static Result<std::unique_ptr<Executor>> create(std::shared_ptr<const Volume> source,
                                                  const Parameters& parameters,
                                                  const ExecutorOptions& options);

  [[nodiscard]] std::string_view name() const override { return "host"; }
  Status restore(const Field& phi) override;
  [[nodiscard]] Result<Field> snapshot() const override;
  Status paint(const Sphere& sphere, Brush brush) override;
  Status set_constraints(std::shared_ptr<const Constraints> constraints) override;
  Result<AdvanceReport> advance(const Advance& run) override;
  [[nodiscard]] MemoryReport memory() const override;
  [[nodiscard]] Result<std::vector<std::int64_t>> quiet_pages() const override {
    return quiet_.virtual_pages();
  }
  [[nodiscard]] Result<std::vector<std::int64_t>> moving_pages() const override {
    return quiet_.moving_pages(watch_);
  }
  [[nodiscard]] bool page_view(PageView& view) const override;
  [[nodiscard]] Status validate() const override;

 private:
  HostExecutor(std::shared_ptr<const Volume> source, const Parameters& parameters,
               const ExecutorOptions& options, PageKernels kernels);

  Status drive(const Parameters& parameters, std::shared_ptr<const SpeedFunction> given) override;
  void step();
  // Steps go through the pages there and back: of a surface that is larger than the cache, a step finds there
  // what the last one left.
  [[nodiscard]] bool goes_back() const { return pages_.current() == 1; }
  void limit(const PageInfo& info, const float* before, float* phi, RowMasks& masks,
             PageResult& result) const;
  std::int64_t update_page(std::size_t index, RowWork work, const PagePrefetch& ahead, Tile& tile);
  std::int64_t update_piece(std::int64_t begin, std::int64_t end, int member);
  Status maintain();
  void begin_window();
  bool finish_window();

  StepConstants<float> constants_;
  PageKernels kernels_;
  PageKernels::Kernel kernel_ = nullptr;  // of this step
  std::unique_ptr<ThreadPool> threads_;
  std::vector<std::unique_ptr<Tile>> tiles_;  // one a thread
  std::vector<std::int64_t> updates_;         // voxels computed in the step, one a thread

  ResidentPages pages_;
  QuietPages quiet_;
  PageEdits edits_;
  std::vector<std::uint8_t> codes_;  // what each active page asks for after a step
  bool window_begins_ = false;       // with the next step: what was summed up so far is forgotten then
};

}  // namespace tidemark::solver
