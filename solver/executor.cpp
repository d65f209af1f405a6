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

// The device of the options, or a new one of OpenGL 4.5; null: there is none.
std::shared_ptr<gpu::Device> device_for(const ExecutorOptions& options) {
  if (options.device != nullptr) return options.device;
  auto made = gpu::Device::create_headless({gpu::GlVersion::gl45, options.debug});
  return made ? *made : nullptr;
}

// Where the processor plays the GPU, host is far faster.
bool is_gpu(const gpu::Device& device) {
  return !device.capabilities().software && device.capabilities().at_least(4, 5);
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
      on_gpu.device = device_for(options);
      const bool has_gpu = on_gpu.device != nullptr && is_gpu(*on_gpu.device);
      const Status passed = has_gpu ? try_compute(on_gpu.device) : Status();
      if (kind == ExecutorKind::automatic && (!has_gpu || !passed)) break;
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
