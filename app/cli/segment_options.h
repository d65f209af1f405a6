// The options of `tidemark-cli segment`.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/drive_options.h"
#include "app/cli/results.h"
#include "app/cli/solver_options.h"
#include "app/cli/start.h"
#include "app/cli/study_input.h"
#include "solver/parameters.h"

namespace tidemark::cli {

struct SegmentOptions {
  StudyInput study;
  std::optional<double> target, range, alpha;  // all needed, unless auto_start; two of them only by a tent
  DriveOptions drive;
  std::optional<double> smooth_mm;
  std::optional<double> rescale, band;
  solver::Scheme scheme = solver::Scheme::split;
  solver::DataForm data_form = solver::DataForm::clamped;
  bool no_data = false, no_curvature = false, no_rescaling = false;
  StartOptions start;
  bool auto_start = false;
  std::optional<std::int64_t> steps, max_steps;
  bool converge = false;
  SolverOptions solver;
  std::optional<std::string> truth;
  std::optional<std::int64_t> truth_label;
  ResultOptions results;

  [[nodiscard]] bool until_converged() const { return !steps; }
  [[nodiscard]] std::int64_t step_limit() const;
  // With target, range and alpha filled in.
  [[nodiscard]] solver::Parameters parameters() const;
};

void add_segment_options(CLI::App& app, SegmentOptions& options);
// The same without the choice of an executor, levels and results: of commands with many runs.
void add_sweep_options(CLI::App& app, SegmentOptions& options);

// All checks that need no file, but for the results.
Status check(const SegmentOptions& options);
// The files and folders that are read beside the study.
[[nodiscard]] std::vector<std::string> inputs_of(const SegmentOptions& options);

}  // namespace tidemark::cli
