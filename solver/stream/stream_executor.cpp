#include "solver/stream/stream_executor.h"

#include "core/stopwatch.h"
#include "solver/gl/packed_view.h"

namespace tidemark::solver {
namespace {

constexpr Index3 kPageShape{16, 16, 1};  // the paper's

}  // namespace

Result<std::unique_ptr<Executor>> StreamExecutor::create(std::shared_ptr<const Volume> source,
                                                         const Parameters& parameters,
                                                         const ExecutorOptions& options,
                                                         std::int64_t largest_region) {
  std::shared_ptr<gpu::Device> device = options.device;
  if (device == nullptr) {
    auto made = gpu::Device::create_headless({gpu::GlVersion::gl33, options.debug});
    if (!made) return pass_on(made);
    device = std::move(*made);
  }
  if (!device->capabilities().at_least(3, 3)) {
    return fail(ErrorKind::capability, "the stream executor needs OpenGL 3.3; {} offers {}.{}",
                device->capabilities().renderer, device->capabilities().major, device->capabilities().minor);
  }
  TIDEMARK_TRY(device->make_current());
  std::unique_ptr<StreamExecutor> executor(
      new StreamExecutor(std::move(device), std::move(source), parameters, options));
  TIDEMARK_TRY(executor->start(largest_region));
  return executor;
}

StreamExecutor::StreamExecutor(std::shared_ptr<gpu::Device> device, std::shared_ptr<const Volume> source,
                               const Parameters& parameters, const ExecutorOptions& options)
    : GlExecutor(std::move(device), std::move(source), parameters, options, kPageShape) {}

Status StreamExecutor::start(std::int64_t largest_region) {
  TIDEMARK_TRY(make_textures());
  active_geometry_ = GeometryEngine::create(*device_, layout_);
  special_geometry_ = GeometryEngine::create(*device_, layout_);
  if (largest_region == 0) {
    largest_region =
        device_->capabilities().software ? RegionPasses::kLargestRegionInCache : RegionPasses::kLargestRegion;
  }
  auto passes = RegionPasses::create(*device_, active_geometry_, drive_textures_, model_, largest_region);
  if (!passes) return pass_on(passes);
  passes_ = std::move(*passes);
  return restore(Field::empty(source_->geometry, band(), kPageShape));
}

// Has what drives the surface filled wherever the next step reads it.
Status StreamExecutor::prepare_drive() {
  if (!drive_textures_.is_filled() || filled_changes_ == pages_.table().changes()) return {};
  std::vector<std::int64_t> pages;
  pages_.for_each_resident([&](PhysicalPage page) { pages.push_back(pages_.virtual_page(page)); });
  TIDEMARK_TRY(GlExecutor::fill_drive(pages, 1));
  filled_changes_ = pages_.table().changes();
  return {};
}

// Computes the active pages and reads their messages.
Status StreamExecutor::step() {
  passes_.step(active_geometry_, memory_, drive_textures_, model_.constants<float>(), current_,
               next_step_is_measured());
  current_ = 1 - current_;
  // The message's own time is to be known; the wait costs nothing that could be measured.
  return gpu::Fence::insert(*device_).wait();
}

// Handles the pages' messages, and the end of a window of steps. Returns whether one ended.
Result<bool> StreamExecutor::finish_step(AdvanceReport& report) {
  const Stopwatch paging;
  Status domain;  // whether all pages could be allocated; the rest fails only with the graphics driver
  if (!active_.empty()) {
    auto messages =
        passes_.message(active_geometry_, memory_, current_, static_cast<float>(band()), kQuietChange);
    if (!messages) return pass_on(messages);
    domain = update_domain(*messages);
  }
  auto window_ended = finish_window();
  if (!window_ended) return window_ended;
  if (active_list_is_stale_) {
    TIDEMARK_TRY(rebuild_active_list());
  }
  report.paging_seconds += paging.seconds();
  if (!domain) {
    return fail(domain.error().kind, "after {} steps: {}", report.steps, domain.error().message);
  }
  return window_ended;
}

Result<AdvanceReport> StreamExecutor::advance(const Advance& run) {
  steps_of_last_run_ = 0;
  TIDEMARK_TRY(make_current());
  if (needs_activation_) {
    TIDEMARK_TRY(activate_pages(resident_pages(), NoRoom::fails));
  }
  if (active_list_is_stale_) {
    TIDEMARK_TRY(rebuild_active_list());
  }
  return run_steps(run, [this](AdvanceReport& report) -> Result<bool> {
    if (!active_.empty()) {
      if (auto evaluated = prepare_drive(); !evaluated) {
        steps_of_last_run_ = --report.steps;
        return pass_on(evaluated);
      }
      TIDEMARK_TRY(step());
      report.voxel_updates += active_geometry_.voxels();
    }
    return finish_step(report);
  });
}

MemoryReport StreamExecutor::memory() const {
  MemoryReport report;
  report.resident_pages = pages_.table().resident();
  report.peak_resident_pages = peak_resident_;
  report.quiet_pages = quiet_pages_;
  report.state_bytes = with_textures(state_bytes(memory_.capacity()));
  report.peak_state_bytes = peak_bytes_;
  report.source_bytes = 0;  // blocks of it count in the state
  report.page_shape = kPageShape;
  return report;
}

bool StreamExecutor::packed_view(PackedView& view) {
  const std::vector<PhysicalPage>& entries = pages_.table().entries();
  const auto bytes = static_cast<std::int64_t>(entries.size() * sizeof(PhysicalPage));
  if (viewed_table_.bytes() != bytes) {
    auto buffer = gpu::Buffer::create(*device_, bytes, "page table");
    if (!buffer) return false;
    viewed_table_ = std::move(*buffer);
    viewed_changes_ = -1;
  }
  if (viewed_changes_ != pages_.table().changes()) {
    viewed_table_.upload_values<PhysicalPage>(0, entries);
    viewed_changes_ = pages_.table().changes();
  }
  view = {layout_, &memory_.field().phi(current_), &viewed_table_, static_cast<float>(band())};
  return true;
}

}  // namespace tidemark::solver
