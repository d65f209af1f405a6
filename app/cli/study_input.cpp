#include "app/cli/study_input.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "app/cli/arguments.h"
#include "app/cli/outputs.h"
#include "core/files_below.h"

namespace tidemark::cli {

imaging::GridPolicy StudyInput::policy(const imaging::GridPolicy& otherwise) const {
  return {tilt.value_or(otherwise.tilt), gaps.value_or(otherwise.gaps)};
}

void add_study_input(CLI::App& app, StudyInput& study) {
  app.add_option("INPUT", study.path,
                 "A DICOM folder, file or DICOMDIR, a volume file, or a zip archive of these")
      ->required()
      ->type_name("");
  add_series_options(app, study, "INPUT");
}

void add_series_options(CLI::App& app, StudyInput& study, const std::string& holder) {
  app.add_option("--series", study.series,
                 "The series to load when " + holder +
                     " holds several (see info); of one that holds\nseveral volumes UID#N is the N-th, UID "
                     "the largest")
      ->type_name("UID[#N]");
  add_grid_options(app, study);
}

void add_grid_options(CLI::App& app, StudyInput& study) {
  using Tilt = imaging::GridPolicy::Tilt;
  using Gaps = imaging::GridPolicy::Gaps;
  const char* const kGroup = "Slices";
  add_choice<std::optional<Tilt>>(
      app, "--tilt", study.tilt, {{"correct", Tilt::correct}, {"keep", Tilt::keep}},
      "Slices of a tilted gantry: moved back (correct, default), or kept in their places (keep: distances\n"
      "across slices are then sheared)")
      ->group(kGroup);
  add_choice<std::optional<Gaps>>(
      app, "--gaps", study.gaps, {{"refuse", Gaps::refuse}, {"fill", Gaps::fill}},
      "Missing slices and uneven distances: not loaded (refuse, default), or interpolated (fill)")
      ->group(kGroup);
}

Result<imaging::ChosenSeries> find_study(const StudyInput& study, const Progress& progress,
                                         const imaging::GridPolicy& otherwise) {
  const auto catalogue = imaging::find_series(study.path, progress, study.policy(otherwise));
  if (!catalogue) return pass_on(catalogue);
  auto chosen = imaging::choose_series(*catalogue, study.series, study.path);
  if (!chosen && imaging::find_fillable(*catalogue, study.series) != nullptr) {
    chosen.error().message += "; --gaps fill interpolates";
  }
  return chosen;
}

Result<imaging::LoadedSeries> load_study(const StudyInput& study, const Progress& progress,
                                         const imaging::GridPolicy& otherwise) {
  auto chosen = find_study(study, progress, otherwise);
  if (!chosen) return pass_on(chosen);
  auto volume = imaging::load_series(*chosen, progress);
  if (!volume) return pass_on(volume);
  return imaging::LoadedSeries{std::move(chosen->series), std::move(*volume)};
}

Status spare_study(const Outputs& outputs, const StudyInput& study, const Progress& progress,
                   const imaging::GridPolicy& otherwise) {
  TIDEMARK_TRY(outputs.spare(study.path));
  std::error_code ignored;
  if (!std::filesystem::is_directory(study.path, ignored)) return {};
  const auto inside = files_below(study.path, progress, {.recursive = true, .skip_denied = true});
  if (!inside) return pass_on(inside);
  const bool holds_none = std::all_of(inside->begin(), inside->end(),
                                      [&](const auto& file) { return outputs.spare(file).has_value(); });
  if (holds_none) return {};
  const auto chosen = find_study(study, progress, otherwise);
  if (!chosen) return pass_on(chosen);
  for (const std::filesystem::path& file : chosen->series.files) TIDEMARK_TRY(outputs.spare(file));
  return {};
}

Status spare_inputs(const Outputs& outputs, const std::vector<std::string>& inputs,
                    const Progress& progress) {
  StudyInput input;
  for (const std::string& path : inputs) {
    input.path = path;
    TIDEMARK_TRY(spare_study(outputs, input, progress));
  }
  return {};
}

}  // namespace tidemark::cli
