#include "app/cli/solver_options.h"

#include <string>

#include "core/thread_pool.h"

namespace tidemark::cli {
namespace {

constexpr std::int64_t kMostThreads = 1024;
constexpr std::int64_t kLargestBudget = std::int64_t{1} << 30;  // MB, so that bytes fit 64 bits

// The slow reference of the tests is not in the help.
solver::ExecutorKind executor_kind(const std::string& name) {
  if (const auto kind = solver::executor_named(name)) return *kind;
  throw CLI::ValidationError("--executor", "'" + name + "' is unknown; use auto, host, compute or stream");
}

}  // namespace

solver::ExecutorOptions SolverOptions::executor_options() const {
  solver::ExecutorOptions options;
  options.threads = static_cast<int>(threads.value_or(0));
  if (memory_budget_mb) options.memory_budget_bytes = *memory_budget_mb * kMebibyte;
  options.skip_quiet_pages = !no_skip;
  return options;
}

void add_solver_options(CLI::App& app, SolverOptions& options, const std::string& otherwise) {
  app.add_option_function<std::string>(
         "--executor", [&options](const std::string& name) { options.kind = executor_kind(name); },
         "What computes: host (the processor), compute (OpenGL 4.5), stream (OpenGL 3.3, the paper's "
         "passes), or auto: "
         "compute on a GPU, else host (default: " +
             otherwise + ")")
      ->type_name("auto|host|compute|stream");
  add_host_options(app, options);
}

void add_host_options(CLI::App& app, SolverOptions& options) {
  add_count(app, "--threads", options.threads,
            "Threads of the host executor, and of pictures that the host draws (default: all processors)");
  add_count(app, "--memory-budget", options.memory_budget_mb,
            "Most memory for the solver, in MB (default: half of what this process may use, by machine or\n"
            "control group); a run that needs more ends with code 4");
  app.add_flag("--no-skip", options.no_skip, "Compute also the pages in which nothing moves any more");
}

int threads_of(const SolverOptions& options, std::string_view executor) {
  if (executor == "reference") return 1;
  return static_cast<int>(options.threads.value_or(available_processors()));
}

Status check(const SolverOptions& options) {
  if (options.threads && (*options.threads < 1 || *options.threads > kMostThreads)) {
    return fail(ErrorKind::usage, "--threads {}: must be 1 to {}", *options.threads, kMostThreads);
  }
  if (options.memory_budget_mb &&
      (*options.memory_budget_mb < 1 || *options.memory_budget_mb > kLargestBudget)) {
    return fail(ErrorKind::usage, "--memory-budget {}: must be 1 to {} MB", *options.memory_budget_mb,
                kLargestBudget);
  }
  return {};
}

}  // namespace tidemark::cli
