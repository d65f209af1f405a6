#include "app/cli/run_inputs.h"

#include "document/checksum.h"
#include "document/truth.h"
#include "imaging/filters/filters.h"
#include "imaging/filters/suggest_start.h"
#include "imaging/load_study.h"
#include "solver/model.h"

namespace tidemark::cli {
namespace {

std::string count_of(const Geometry& geometry) {
  return fmt::format("{} x {} x {} voxels of {:.4g} x {:.4g} x {:.4g} mm", geometry.size.x, geometry.size.y,
                     geometry.size.z, geometry.spacing_mm.x, geometry.spacing_mm.y, geometry.spacing_mm.z);
}

class Inputs {
 public:
  Inputs(SegmentOptions& options, bool wants_checksum, Console& console, RunResults& results)
      : options_(options), wants_checksum_(wants_checksum), console_(console), results_(results) {}

  Result<std::optional<BitMask>> read();

 private:
  Status load();
  Status load_truth();
  Status suggest();
  Status make_recipe();

  SegmentOptions& options_;
  bool wants_checksum_;
  Console& console_;
  RunResults& results_;
  StudyPlace study_;
  std::optional<BitMask> truth_;
};

Result<std::optional<BitMask>> Inputs::read() {
  for (const auto step : {&Inputs::load, &Inputs::load_truth, &Inputs::suggest, &Inputs::make_recipe}) {
    TIDEMARK_TRY((this->*step)());
    if (console_.interrupted()) return cancelled_error();
  }
  return std::move(truth_);
}

Status Inputs::load() {
  auto study = load_study(options_.study, console_.progress());
  if (!study) return pass_on(study);
  results_.dicom_files = imaging::dicom_files_of(study->series);
  results_.archive = study->series.archive;
  study_ = place_of(*study);
  Result<Volume> volume = std::move(study->volume);
  TIDEMARK_TRY(check_inside(options_.start, volume->geometry));
  RunFigures& figures = results_.figures;
  figures.geometry = volume->geometry;
  figures.modality = volume->modality;
  figures.unit = volume->unit;
  figures.description = volume->description;
  figures.series_uid = study->series.uid;
  figures.changes = volume->changes;
  figures.smooth_mm = options_.smooth_mm;
  console_.say("Loaded     {}{}{}, {}", volume->modality, volume->modality.empty() ? "" : ": ",
               count_of(volume->geometry), volume->scalar_name());
  for (const std::string& change : volume->changes) console_.say("           {}", change);
  document::Recipe& recipe = results_.recipe;
  recipe.source = {
      volume->geometry.size, volume->geometry.spacing_mm, options_.study.series, {}, study->series.policy};
  if (wants_checksum_) recipe.source.checksum = document::checksum_of(*volume);
  if (options_.smooth_mm) {
    console_.log("smoothing by {} mm", *options_.smooth_mm);
    volume = imaging::smooth(*volume, *options_.smooth_mm);
    if (!volume) return pass_on(volume);
  }
  results_.source = std::make_shared<const Volume>(std::move(*volume));
  return {};
}

Status Inputs::load_truth() {
  if (!options_.truth) return {};
  auto truth = document::load_truth(*options_.truth, options_.truth_label, results_.source->geometry,
                                    console_.progress());
  if (!truth && truth.error().kind == ErrorKind::usage) {
    return fail(ErrorKind::usage, "--truth-label {}", truth.error().message);
  }
  if (!truth) return pass_on(truth);
  truth_ = std::move(*truth);
  return {};
}

// Fills in the options that the user has left out.
Status Inputs::suggest() {
  if (!options_.auto_start) return {};
  const bool needs_seed = !options_.start.given();
  const bool tent = options_.drive.uses_tent();
  if (!needs_seed && (!tent || (options_.target && options_.range)) && options_.alpha) return {};
  imaging::StartHints hints;
  if (tent) {
    hints.target = options_.target;
    hints.range = options_.range;
  }
  if (!options_.start.seeds.empty()) {
    const auto sphere = options_.start.seeds.front().resolve(results_.source->geometry);
    if (!sphere) return pass_on(sphere);
    const glm::dvec3 voxel = results_.source->geometry.to_voxel(sphere->centre_mm);
    hints.seed = glm::clamp(Index3(glm::round(voxel)), Index3(0), results_.source->geometry.size - Index3(1));
  }
  const auto found = imaging::suggest_start(*results_.source, hints, console_.progress());
  if (console_.interrupted()) return cancelled_error();
  if (!found) return fail(found.error().kind, "--auto-start: {}", found.error().message);
  if (needs_seed) {
    const std::string text =
        fmt::format("{},{},{},{:.4g}", found->voxel.x, found->voxel.y, found->voxel.z, found->radius_mm);
    options_.start.seeds.push_back({"--seed " + text, glm::dvec3(found->voxel), true, found->radius_mm});
    console_.say("Chose      --seed {}", text);
  }
  const auto fill = [&](const char* name, std::optional<double>& value, double suggestion) {
    if (value) return;
    value = suggestion;
    console_.say("Chose      {} {:.6g}", name, suggestion);
  };
  if (tent) {
    fill("--target", options_.target, found->target);
    fill("--range", options_.range, found->range);
  }
  fill("--alpha", options_.alpha, found->alpha);
  return {};
}

// All that the run does.
Status Inputs::make_recipe() {
  document::Recipe& recipe = results_.recipe;
  recipe.parameters = options_.parameters();
  recipe.steps = options_.step_limit();
  const double band = recipe.parameters.band.value_or(solver::default_band(study_.grid));
  // The band as executors round it.
  auto start = make_start(options_.start, study_, static_cast<float>(band), console_);
  if (!start) return pass_on(start);
  recipe.start = std::move(*start);
  if (options_.drive.within_mm) {
    auto refined =
        limited(std::get<document::MaskStart>(std::move(recipe.start.from)), *options_.drive.within_mm);
    if (!refined) return pass_on(refined);
    recipe.start.from = std::move(*refined);
  }
  auto drive = make_drive(options_.drive, study_, console_);
  if (!drive) return pass_on(drive);
  recipe.drive = std::move(*drive);
  return {};
}

}  // namespace

Result<std::optional<BitMask>> read_inputs(SegmentOptions& options, bool wants_checksum, Console& console,
                                           RunResults& results) {
  return Inputs(options, wants_checksum, console, results).read();
}

}  // namespace tidemark::cli
