// The level set on the processor: pages of 8^3 voxels, vectorised, shared among threads.
#pragma once

#include <memory>
#include <vector>

#include "core/thread_pool.h"
#include "solver/convergence.h"
#include "solver/executor_base.h"
#include "solver/host/page_kernel.h"
#include "solver/host/page_pool.h"
#include "solver/paging/page_table.h"

namespace tidemark {

// A step reads phi from one buffer and writes it to the other (Jacobi), so its result does not depend on the
// order of pages: the same bits for any number of threads. Between steps pages are allocated and freed from
// the codes that the pages wrote.
class HostExecutor final : public ExecutorBase {
 public:
  // The instruction set is the widest one, or the one that $TIDEMARK_SIMD names.
  static Result<std::unique_ptr<Executor>> create(std::shared_ptr<const Volume> source,
                                                  const Parameters& parameters,
                                                  const ExecutorOptions& options);

  [[nodiscard]] std::string_view name() const override { return "host"; }
  Status restore(const Field& phi) override;
  [[nodiscard]] Result<Field> snapshot() const override;
  Status paint(const Sphere& sphere, Brush brush) override;
  Status set_parameters(const Parameters& parameters) override;
  Result<AdvanceReport> advance(const Advance& run) override;
  [[nodiscard]] MemoryReport memory() const override;
  [[nodiscard]] Result<std::vector<std::int64_t>> quiet_pages() const override;
  [[nodiscard]] Status validate() const override;

  [[nodiscard]] const std::string& instruction_set() const { return kernels_.name; }

 private:
  HostExecutor(std::shared_ptr<const Volume> source, const Parameters& parameters,
               const ExecutorOptions& options, PageKernels kernels);

  // Steps (host_executor.cpp).
  void step();
  // Steps go through the pages there and back: of a surface that is larger than the cache, a step finds there
  // what the last one left.
  [[nodiscard]] bool goes_back() const { return current_ == 1; }
  std::int64_t update_page(std::size_t index, RowWork work, const PagePrefetch& ahead, Tile& tile);
  std::int64_t update_piece(std::int64_t begin, std::int64_t end, int member);
  void begin_window();
  bool finish_window();

  // Which pages are resident (domain.cpp).
  [[nodiscard]] PhysicalPage pool_capacity() const;
  void clear();
  void describe_page(PhysicalPage page);
  void link_neighbours(PhysicalPage page);
  void tell_neighbours(Index3 coordinates, PhysicalPage page);
  void refresh_masks(PhysicalPage page);
  [[nodiscard]] std::uint8_t page_code(PhysicalPage page, int buffer);
  [[nodiscard]] bool surroundings_are_constant(PhysicalPage page, bool inside) const;
  [[nodiscard]] Status check_budget(std::int64_t more_pages) const;
  Result<PhysicalPage> make_resident(std::int64_t virtual_page);
  Status make_neighbours_resident(PhysicalPage page, std::uint8_t code);
  void fill_new_pages();
  void fill_data_motion(PhysicalPage page);
  void refill_data_motion();
  void release_page(PhysicalPage page);
  Status update_domain();
  Status activate_all();

  // Quiet pages (quiet.cpp).
  void wake(PhysicalPage page);
  void wake_around(PhysicalPage page);
  void wake_all();
  void put_to_sleep(PhysicalPage page);
  void judge_quiet_pages();
  void rebuild_active_list();

  template <class Visit>
  void for_each_resident(Visit visit) const {
    for (PhysicalPage page = kFirstPage; page < table_.capacity(); ++page) {
      if (table_.virtual_page(page) >= 0) visit(page);
    }
  }

  StepConstants<float> constants_;
  ExecutorOptions options_;
  PageKernels kernels_;
  PageKernels::Kernel kernel_ = nullptr;  // of this step
  std::unique_ptr<ThreadPool> threads_;
  std::vector<std::unique_ptr<Tile>> tiles_;  // one a thread
  std::vector<std::int64_t> updates_;         // voxels computed in the step, one a thread

  PageTable table_;
  PagePool pool_{kFirstPage};
  int current_ = 0;  // the buffer that holds phi
  // The pages that are computed, in the order of their virtual numbers: each thread's share is then one
  // region of the surface, and few of its pages are beside one that another thread writes.
  std::vector<PhysicalPage> active_;
  std::vector<std::uint8_t> codes_;      // what each of them asks for after a step
  std::vector<PhysicalPage> new_pages_;  // resident since this maintenance, not filled yet
  // The virtual numbers of all resident pages, and of those freed since the active list was built: first so
  // many in order, then those made resident since.
  std::vector<std::int64_t> listed_;
  std::ptrdiff_t listed_in_order_ = 0;
  bool active_list_is_stale_ = true;
  bool needs_activation_ = false;  // the budget stopped an allocation
  std::int64_t quiet_pages_ = 0;
  std::int64_t quiet_near_voxels_ = 0;  // in quiet pages, as last seen
  std::int64_t peak_resident_ = 0;
};

}  // namespace tidemark
