#include "solver/executor.h"

#include "solver/host/host_executor.h"
#include "solver/reference/reference_executor.h"

namespace tidemark {

Result<std::unique_ptr<Executor>> make_executor(ExecutorKind kind, std::shared_ptr<const Volume> source,
                                                const Parameters& parameters,
                                                const ExecutorOptions& options) {
  if (auto status = check(parameters); !status) return pass_on(status);
  switch (kind) {
    case ExecutorKind::reference:
      return std::make_unique<ReferenceExecutor>(std::move(source), parameters);
    case ExecutorKind::automatic:
    case ExecutorKind::host:
      break;
  }
  return HostExecutor::create(std::move(source), parameters, options);
}

}  // namespace tidemark
