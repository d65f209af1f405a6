#include "solver/executor.h"

#include "core/machine_memory.h"
#include "gpu/device.h"
#include "solver/compute/compute_executor.h"
#include "solver/host/host_executor.h"
#include "solver/reference/reference_executor.h"
#include "solver/stream/stream_executor.h"
#include "solver/trial.h"

namespace tidemark::solver {
namespace {

// A context of OpenGL 4.5 on a real GPU, if this machine has one: where the processor plays the GPU, host is
// far faster.
std::shared_ptr<gpu::Device> hardware_device(const ExecutorOptions& options) {
  auto device = options.device;
  if (device == nullptr) {
    auto made = gpu::Device::create_headless({gpu::GlVersion::gl45, options.debug});
    if (!made) return nullptr;
    device = *made;
  }
  const gpu::Capabilities& capabilities = device->capabilities();
  return capabilities.software || !capabilities.at_least(4, 5) ? nullptr : device;
}

}  // namespace

std::int64_t default_memory_budget() {
  return machine_memory() / 2;
}

std::optional<ExecutorKind> executor_named(std::string_view name) {
  if (name == "auto") return ExecutorKind::automatic;
  if (name == "host") return ExecutorKind::host;
  if (name == "compute") return ExecutorKind::compute;
  if (name == "stream") return ExecutorKind::stream;
  if (name == "reference") return ExecutorKind::reference;
  return std::nullopt;
}

Result<std::unique_ptr<Executor>> make_executor(ExecutorKind kind, std::shared_ptr<const Volume> source,
                                                const Parameters& parameters,
                                                const ExecutorOptions& options) {
  TIDEMARK_TRY(check(parameters));
  switch (kind) {
    case ExecutorKind::automatic:
    case ExecutorKind::compute: {
      ExecutorOptions on_gpu = options;
      const auto device = hardware_device(options);
      if (device != nullptr) on_gpu.device = device;
      const Status passed = device != nullptr ? try_compute(device) : Status();
      const bool automatic = kind == ExecutorKind::automatic;
      if (automatic && (device == nullptr || !passed)) break;
      TIDEMARK_TRY(passed);
      return ComputeExecutor::create(std::move(source), parameters, on_gpu);
    }
    case ExecutorKind::stream:
      return StreamExecutor::create(std::move(source), parameters, options);
    case ExecutorKind::reference:
      return std::make_unique<ReferenceExecutor>(std::move(source), parameters, options.page_shape);
    case ExecutorKind::host:
      break;
  }
  return HostExecutor::create(std::move(source), parameters, options);
}

}  // namespace tidemark::solver
