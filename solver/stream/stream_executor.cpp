#include "solver/stream/stream_executor.h"

#include <chrono>

namespace tidemark {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

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
  if (auto status = device->make_current(); !status) return pass_on(status);
  std::unique_ptr<StreamExecutor> executor(
      new StreamExecutor(std::move(device), std::move(source), parameters, options));
  if (auto status = executor->start(largest_region); !status) return pass_on(status);
  return executor;
}

StreamExecutor::StreamExecutor(std::shared_ptr<gpu::Device> device, std::shared_ptr<const Volume> source,
                               const Parameters& parameters, const ExecutorOptions& options)
    : device_(std::move(device)),
      source_(std::move(source)),
      model_(*source_, parameters),
      options_(options),
      layout_(PageLayout(source_->geometry.size, kPageShape), device_->capabilities().largest_texture) {}

Status StreamExecutor::start(std::int64_t largest_region) {
  auto texture = SourceTexture::create(*device_, *source_);
  if (!texture) return pass_on(texture);
  source_texture_ = std::move(*texture);
  active_geometry_ = GeometryEngine::create(*device_, layout_);
  special_geometry_ = GeometryEngine::create(*device_, layout_);
  if (largest_region == 0) {
    largest_region =
        device_->capabilities().software ? RegionPasses::kLargestRegionInCache : RegionPasses::kLargestRegion;
  }
  auto passes = RegionPasses::create(*device_, active_geometry_, source_texture_, model_, largest_region);
  if (!passes) return pass_on(passes);
  passes_ = std::move(*passes);
  return restore(Field::empty(source_->geometry, band(), kPageShape));
}

// Computes the active pages and reads what they send.
Status StreamExecutor::step() {
  // The change over two steps is known after the second of them.
  const bool measure_motion = steps_in_window_ % 2 == 1;
  passes_.step(active_geometry_, memory_, source_texture_, model_.constants<float>(), current_,
               measure_motion);
  current_ = 1 - current_;
  // The message's own time is to be known.
  return gpu::Fence::insert(*device_).wait();
}

// `domain` tells whether all pages could be allocated; the rest fails only with the graphics driver.
Status StreamExecutor::handle_message(bool& window_ended, Status& domain) {
  if (!active_.empty()) {
    const Clock::time_point start = Clock::now();
    auto messages =
        passes_.message(active_geometry_, memory_, current_, static_cast<float>(band()), kQuietChange);
    if (!messages) return pass_on(messages);
    domain = update_domain(*messages);
    ++message_cost_.messages;
    message_cost_.bytes += static_cast<std::int64_t>(messages->size());
    message_cost_.seconds += seconds_since(start);
  }
  auto ended = finish_window();
  if (!ended) return pass_on(ended);
  window_ended = *ended;
  if (active_list_is_stale_) return rebuild_active_list();
  return {};
}

Result<AdvanceReport> StreamExecutor::advance(const Advance& run) {
  const Clock::time_point start = Clock::now();
  Clock::time_point last_progress = start;
  AdvanceReport report;
  if (auto status = device_->make_current(); !status) return pass_on(status);
  gpu::begin_exact_drawing();
  if (unsettled_) {
    if (auto status = settle(resident_pages()); !status) return pass_on(status);
  }
  if (active_list_is_stale_) {
    if (auto status = rebuild_active_list(); !status) return pass_on(status);
  }
  while (report.steps < run.steps && !run.progress.cancelled()) {
    if (!active_.empty()) {
      if (auto status = step(); !status) return pass_on(status);
      report.voxel_updates += active_geometry_.voxels();
    }
    ++report.steps;

    const Clock::time_point paging_start = Clock::now();
    bool window_ended = false;
    Status domain;
    if (auto status = handle_message(window_ended, domain); !status) return pass_on(status);
    report.paging_seconds += seconds_since(paging_start);
    if (!domain) {
      return fail(domain.error().kind, "after {} steps: {}", report.steps, domain.error().message);
    }
    if (seconds_since(last_progress) > 0.05) {
      run.progress(static_cast<double>(report.steps) / static_cast<double>(run.steps), "steps");
      last_progress = Clock::now();
    }
    if (window_ended) {
      report.converged = surface_speed_ < kConvergedSpeed;
      if (report.converged && run.until_converged) break;
    }
  }
  report.surface_speed = surface_speed_;
  report.seconds = seconds_since(start);
  return report;
}

MemoryReport StreamExecutor::memory() const {
  MemoryReport report;
  report.resident_pages = table_.resident();
  report.peak_resident_pages = peak_resident_;
  report.quiet_pages = quiet_pages_;
  report.state_bytes = state_bytes(memory_.capacity());
  report.peak_state_bytes = peak_bytes_;
  report.source_bytes = 0;  // the source is one texture, whatever is resident
  report.page_shape = kPageShape;
  return report;
}

}  // namespace tidemark
