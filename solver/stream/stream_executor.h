// The level set by the paper's own render passes: OpenGL 3.3, one byte a page sent to the processor, which
// keeps page table, inverse page table and free stack (paper sections 3 and 4).
#pragma once

#include <memory>
#include <vector>

#include "gpu/device.h"
#include "solver/gl/gl_executor.h"
#include "solver/paging/paged_memory.h"
#include "solver/stream/geometry_engine.h"
#include "solver/stream/pass_record.h"
#include "solver/stream/physical_memory.h"
#include "solver/stream/region_passes.h"

namespace tidemark::solver {

// Its pages are the paper's, (16,16,1). A step draws the pages of the active list; then their messages are
// read, and the processor allocates and frees pages before the next step.
class StreamExecutor final : public GlExecutor {
 public:
  // On options.device, else on a context of its own. Fails (ErrorKind::capability) without OpenGL 3.3.
  // `largest_region` is how many pages are computed at a time in the intermediate buffers.
  static Result<std::unique_ptr<Executor>> create(std::shared_ptr<const Volume> source,
                                                  const Parameters& parameters,
                                                  const ExecutorOptions& options,
                                                  std::int64_t largest_region = 0);

  [[nodiscard]] std::string_view name() const override { return "stream"; }
  [[nodiscard]] Result<Field> snapshot() const override;
  Status paint(const Sphere& sphere, Brush brush) override;
  Result<AdvanceReport> advance(const Advance& run) override;
  [[nodiscard]] MemoryReport memory() const override;
  [[nodiscard]] Result<std::vector<std::int64_t>> quiet_pages() const override;
  [[nodiscard]] Result<std::vector<std::int64_t>> moving_pages() const override;
  bool packed_view(PackedView& view) override;
  // Of a function that follows the surface, the D in use.
  [[nodiscard]] Result<PassRecord> record_step(std::int64_t page) override;
  [[nodiscard]] Status validate() const override;

 private:
  StreamExecutor(std::shared_ptr<gpu::Device> device, std::shared_ptr<const Volume> source,
                 const Parameters& parameters, const ExecutorOptions& options);
  Status start(std::int64_t largest_region);

  // The facts kept beside a physical page.
  struct PageInfo {
    PageRest rest;
    std::uint8_t constant_steps = 0;
    bool asleep = false;
    bool woke_neighbours = false;  // in this window
  };
  PageInfo& info(PhysicalPage page) { return infos_[page]; }
  [[nodiscard]] const PageInfo& info(PhysicalPage page) const { return infos_[page]; }

  // Steps (stream_executor.cpp).
  Status prepare_drive();
  Status step();
  Result<bool> finish_step(AdvanceReport& report);

  // Which pages are resident (domain.cpp).
  [[nodiscard]] std::int64_t state_bytes(std::int64_t capacity) const;
  Status make_room(std::int64_t more_pages);
  Result<PhysicalPage> make_resident(std::int64_t virtual_page);
  [[nodiscard]] std::uint8_t requests(PhysicalPage page, PageMessage message) const;
  Status grant_requests(PhysicalPage page, std::uint8_t requests);
  [[nodiscard]] PageDecision decide(PhysicalPage page, PageMessage message) const;
  Status fill_new_pages();
  void release_page(PhysicalPage page, bool inside);
  Status update_domain(const std::vector<PageMessage>& messages);
  [[nodiscard]] std::vector<PhysicalPage> resident_pages() const;
  Status activate_pages(std::vector<PhysicalPage> asked, NoRoom no_room);
  Status validate_sleeping_pages() const;

  // Replacing phi, painting, and what drives the surface (edit.cpp).
  Status replace(const Field& phi) override;
  Status compile_for_drive() override;
  Status wake_all_pages() override;
  [[nodiscard]] Status make_current() const override;
  struct PaintPlan {
    std::vector<std::int64_t> to_draw;  // virtual pages, some of them to be made resident
    std::vector<float> values;          // for each of these, the values that phi is combined with
    std::vector<std::int64_t> to_flip;  // not resident, and changing from all outside to inside or back
    std::int64_t to_allocate = 0;
  };
  [[nodiscard]] PaintPlan plan_paint(const Sphere& sphere, Brush brush) const;

  // The record of a step (recording.cpp).
  [[nodiscard]] std::vector<PhysicalPage> recorded_pages(PhysicalPage page) const;
  void record_address(PassRecord& record) const;
  Status record_phi(PassRecord& record) const;
  Status record_passes(PassRecord& record, const std::vector<PhysicalPage>& pages);

  // Quiet pages (quiet.cpp).
  void wake(PhysicalPage page);
  void wake_around(PhysicalPage page);
  void begin_window();
  Result<bool> finish_window();
  Status judge_quiet_pages(const std::vector<PageMotion>& motion);
  Status rebuild_active_list();

  PhysicalMemory memory_;
  GeometryEngine active_geometry_;   // of the active list
  GeometryEngine special_geometry_;  // of pages that are filled, copied, painted or asked
  RegionPasses passes_;

  PagedMemory<3> pages_;
  PageField<PageInfo, 1, 1> infos_;
  std::vector<PhysicalPage> active_;  // the pages that are computed
  std::vector<PhysicalPage> new_[2];  // resident since this maintenance, not filled yet: outside, inside
  int current_ = 0;                   // the buffer that holds phi
  bool active_list_is_stale_ = true;
  bool needs_activation_ = false;  // the budget stopped an allocation
  std::int64_t quiet_pages_ = 0;
  std::int64_t filled_changes_ = -1;  // of the table, when its pages' surroundings were filled

  gpu::Buffer viewed_table_;          // the page table as packed_view() gave it last
  std::int64_t viewed_changes_ = -1;  // of the table, when it did
};

}  // namespace tidemark::solver
