// The study that a command works on, and the options for slices that make no regular grid.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "imaging/load_study.h"

namespace tidemark::cli {

class Outputs;

struct StudyInput {
  std::string path;
  std::string series;  // UID, when there are several
  std::optional<imaging::GridPolicy::Tilt> tilt;
  std::optional<imaging::GridPolicy::Gaps> gaps;

  // The given options, else the defaults.
  [[nodiscard]] imaging::GridPolicy policy(const imaging::GridPolicy& otherwise = {}) const;
};

// INPUT and the options of add_series_options().
void add_study_input(CLI::App& app, StudyInput& study);
// --series, --tilt and --gaps; `holder` is what may hold several series.
void add_series_options(CLI::App& app, StudyInput& study, const std::string& holder);
// --tilt and --gaps.
void add_grid_options(CLI::App& app, StudyInput& study);

// The series that load_study() takes, before any voxel is read. Where filling gaps would make one loadable,
// the error names the option.
Result<imaging::ChosenSeries> find_study(const StudyInput& study, const Progress& progress,
                                         const imaging::GridPolicy& otherwise = {});
Result<imaging::LoadedSeries> load_study(const StudyInput& study, const Progress& progress,
                                         const imaging::GridPolicy& otherwise = {});

// Fails (ErrorKind::usage) when an announced file is the study, or a file that load_study() reads of a
// folder: inputs are never written to. Headers are read only where the folder holds an announced file.
Status spare_study(const Outputs& outputs, const StudyInput& study, const Progress& progress,
                   const imaging::GridPolicy& otherwise = {});
// The same of files and folders that are read beside the study, each as a study of its own.
Status spare_inputs(const Outputs& outputs, const std::vector<std::string>& inputs, const Progress& progress);

}  // namespace tidemark::cli
