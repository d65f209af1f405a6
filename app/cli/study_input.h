// The study that a command works on, and the options for slices that make no regular grid.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "core/progress.h"
#include "imaging/load_study.h"

namespace tidemark::cli {

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

}  // namespace tidemark::cli
