// The options of every command that runs the solver.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <optional>

#include "app/cli/arguments.h"
#include "solver/executor.h"

namespace tidemark::cli {

struct SolverOptions {
  ExecutorKind kind = ExecutorKind::automatic;
  std::optional<std::int64_t> threads;           // unset: all processors
  std::optional<std::int64_t> memory_budget_mb;  // unset: the executor's own limit
  bool no_skip = false;

  [[nodiscard]] ExecutorOptions executor_options() const;
};

// --executor, --threads, --memory-budget and --no-skip.
void add_solver_options(CLI::App& app, SolverOptions& options);

// Fails (ErrorKind::usage) naming the option.
Status check(const SolverOptions& options);

}  // namespace tidemark::cli
