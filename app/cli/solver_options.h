// The options of every command that runs the solver.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "app/cli/arguments.h"
#include "solver/executor.h"

namespace tidemark::cli {

struct SolverOptions {
  std::optional<solver::ExecutorKind> kind;      // unset: the command's default
  std::optional<std::int64_t> threads;           // unset: all processors
  std::optional<std::int64_t> memory_budget_mb;  // unset: default_memory_budget()
  bool no_skip = false;

  [[nodiscard]] solver::ExecutorOptions executor_options() const;
};

// --executor, --threads, --memory-budget and --no-skip; `otherwise` names the executor without --executor.
void add_solver_options(CLI::App& app, SolverOptions& options, const std::string& otherwise = "auto");

// The last three of them alone: where the host executor computes anyway.
void add_host_options(CLI::App& app, SolverOptions& options);

// How many threads that executor computes with.
[[nodiscard]] int threads_of(const SolverOptions& options, std::string_view executor);

// Fails (ErrorKind::usage) naming the option.
Status check(const SolverOptions& options);

}  // namespace tidemark::cli
