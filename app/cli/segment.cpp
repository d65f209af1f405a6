// tidemark-cli segment: from a volume and a start to mask, surface and figures.
#include <filesystem>
#include <memory>

#include "app/cli/program.h"
#include "app/cli/segment_options.h"
#include "document/checksum.h"
#include "imaging/filters/filters.h"
#include "imaging/filters/suggest_start.h"
#include "imaging/load_study.h"
#include "imaging/onto_grid.h"
#include "solver/model.h"

namespace tidemark::cli {
namespace {

constexpr const char* kSummary = "Grows a surface from a start and writes mask, surface and figures";
constexpr const char* kDescription =
    "Segments INPUT: a surface starts at seeds or a mask, grows where brightness is within target -+ range\n"
    "(the volume's units, HU for CT), and is smoothed by its curvature. Voxel indices I,J,K are 0-based;\n"
    "radii, patient coordinates X,Y,Z (LPS) and smoothing are in mm. An interrupted run writes nothing.";

constexpr const char* kExamples =
    "  tidemark-cli segment brain/ --target 800 --range 120 --alpha 0.6 --seed 90,110,80,5 --out "
    "mask.nii.gz\n"
    "  tidemark-cli segment ct.nrrd --target 100 --range 40 --alpha 0.5 --seed-mm=-60,20,110,8 --smooth 1.5 "
    "\\\n"
    "      --out liver.nii.gz --out liver.stl --stats liver.json\n"
    "  tidemark-cli segment ct.nrrd --target 100 --range 40 --alpha 0.5 --init old.nii.gz --steps 200 "
    "--out-phi "
    "phi.nrrd\n"
    "  tidemark-cli segment ct.nrrd --target 100 --range 40 --alpha 0.5 --init-phi phi.nrrd --out "
    "new.nii.gz\n"
    "  tidemark-cli segment ct/ --target 100 --range 40 --alpha 0.5 --seed-mm=-60,20,110,8 --out seg.dcm "
    "\\\n"
    "      --rtstruct contours.dcm --label Liver,liver\n"
    "  tidemark-cli segment unknown/ --auto-start --out first-look.stl\n";

std::string count_of(const Geometry& geometry) {
  return fmt::format("{} x {} x {} voxels of {:.4g} x {:.4g} x {:.4g} mm", geometry.size.x, geometry.size.y,
                     geometry.size.z, geometry.spacing_mm.x, geometry.spacing_mm.y, geometry.spacing_mm.z);
}

// One run of the command.
class Segmentation {
 public:
  Segmentation(Program& program, SegmentOptions options)
      : console_(program.console), options_(std::move(options)), writer_(options_.results, console_) {}

  Status run();

 private:
  Status load();
  Status load_truth();
  Status load_true_segments();
  Status suggest();
  Status make_recipe();
  Status evolve();
  void say_warnings();

  Console& console_;
  SegmentOptions options_;
  ResultWriter writer_;
  std::optional<Mask> truth_;
  RunResults results_;
};

Status Segmentation::run() {
  TIDEMARK_TRY(check(options_));
  TIDEMARK_TRY(writer_.prepare());
  for (const std::string& input : inputs_of(options_)) {
    TIDEMARK_TRY(writer_.spare(input));
  }
  for (const auto step :
       {&Segmentation::load, &Segmentation::load_truth, &Segmentation::suggest, &Segmentation::evolve}) {
    TIDEMARK_TRY((this->*step)());
    if (console_.interrupted()) return cancelled_error();
  }
  TIDEMARK_TRY(writer_.write(results_));
  say_warnings();
  console_.result(to_json(results_.figures));
  return {};
}

Status Segmentation::load() {
  auto study = load_study(options_.study, console_.progress());
  if (!study) return pass_on(study);
  results_.dicom_files = imaging::dicom_files_of(study->series);
  results_.archive = study->series.archive;
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
  if (writer_.wants_recipe()) recipe.source.checksum = document::checksum_of(*volume);
  if (options_.smooth_mm) {
    console_.log("smoothing by {} mm", *options_.smooth_mm);
    volume = imaging::smooth(*volume, *options_.smooth_mm);
    if (!volume) return pass_on(volume);
  }
  results_.source = std::make_shared<const Volume>(std::move(*volume));
  return {};
}

Status Segmentation::load_truth() {
  if (!options_.truth) return {};
  if (imaging::result_form_of(*options_.truth)) return load_true_segments();
  auto labels = imaging::load_volume(*options_.truth, {}, console_.progress());
  if (!labels) return pass_on(labels);
  Mask mask{labels->geometry,
            std::vector<std::uint8_t>(static_cast<std::size_t>(labels->geometry.voxel_count()))};
  for (std::int64_t offset = 0; offset < labels->geometry.voxel_count(); ++offset) {
    const float value = labels->value(offset);
    const bool inside =
        options_.truth_label ? value == static_cast<float>(*options_.truth_label) : value != 0.0F;
    mask.voxels[static_cast<std::size_t>(offset)] = inside ? 1 : 0;
  }
  auto aligned = imaging::onto_grid(std::move(mask), results_.source->geometry, *options_.truth);
  if (!aligned) return pass_on(aligned);
  truth_ = std::move(*aligned);
  return {};
}

// Of a DICOM segmentation or structure set: all segments, or the one of that number.
Status Segmentation::load_true_segments() {
  auto segments = imaging::read_result(*options_.truth, &results_.source->geometry);
  if (!segments) return pass_on(segments);
  if (options_.truth_label) {
    const auto count = static_cast<std::int64_t>(segments->list.size());
    if (*options_.truth_label < 1 || *options_.truth_label > count) {
      return fail(ErrorKind::usage, "--truth-label {}: {} has the segments 1 to {}", *options_.truth_label,
                  *options_.truth, count);
    }
    segments->list = {segments->list[static_cast<std::size_t>(*options_.truth_label - 1)]};
  }
  truth_ = imaging::union_of(*segments);
  return {};
}

// Fills in the options that the user has left out.
Status Segmentation::suggest() {
  if (!options_.auto_start) return {};
  const bool needs_seed = !options_.start.given();
  const bool tent = options_.drive.uses_tent();
  if (!needs_seed && (!tent || (options_.target && options_.range)) && options_.alpha) return {};
  std::optional<Index3> looked_at;
  if (!options_.start.seeds.empty()) {
    const auto sphere = options_.start.seeds.front().resolve(results_.source->geometry);
    if (!sphere) return tl::unexpected<Error>(sphere.error());
    const glm::dvec3 voxel = results_.source->geometry.to_voxel(sphere->centre_mm);
    looked_at = glm::clamp(Index3(glm::round(voxel)), Index3(0), results_.source->geometry.size - Index3(1));
  }
  const auto found = imaging::suggest_start(*results_.source, looked_at, console_.progress());
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

Status Segmentation::evolve() {
  TIDEMARK_TRY(make_recipe());
  RunFigures& figures = results_.figures;
  document::Recipe& recipe = results_.recipe;
  if (recipe.drive != nullptr) console_.say("Speed      {}", describe(*recipe.drive));
  console_.say("Start      {}", recipe.start.describe());
  const auto kind = options_.solver.kind.value_or(solver::ExecutorKind::automatic);
  auto evolution = document::evolve(recipe, results_.source,
                                    {kind, options_.solver.executor_options(), options_.until_converged()},
                                    console_.progress());
  if (!evolution) return pass_on(evolution);
  if (console_.interrupted()) return cancelled_error();
  results_.take(std::move(*evolution));
  recipe.smoothed_mm = options_.smooth_mm.value_or(0.0);  // by load(): evolve() smooths nothing
  figures.threads = threads_of(options_.solver, figures.executor);
  if (const auto* mask = std::get_if<document::MaskStart>(&recipe.start.from)) {
    figures.change = change_between(*mask->mask, results_.mask);
  }
  if (truth_) figures.dice = dice(results_.mask, *truth_);
  return {};
}

// All that the run does.
Status Segmentation::make_recipe() {
  document::Recipe& recipe = results_.recipe;
  const Geometry& grid = results_.source->geometry;
  recipe.parameters = options_.parameters();
  recipe.steps = options_.step_limit();
  const double band = recipe.parameters.band.value_or(solver::default_band(grid));
  auto start = make_start(options_.start, grid, static_cast<float>(band), console_);  // as executors round it
  if (!start) return pass_on(start);
  recipe.start = std::move(*start);
  if (options_.drive.within_mm) {
    auto refined =
        limited(std::get<document::MaskStart>(std::move(recipe.start.from)), *options_.drive.within_mm);
    if (!refined) return pass_on(refined);
    recipe.start.from = std::move(*refined);
  }
  auto drive = make_drive(options_.drive, grid, console_);
  if (!drive) return pass_on(drive);
  recipe.drive = std::move(*drive);
  return {};
}

void Segmentation::say_warnings() {
  const RunFigures& figures = results_.figures;
  if (const std::string advice = advice_on(figures); !advice.empty()) console_.warn(advice);
  if (options_.until_converged() && !figures.advance.converged) {
    console_.warn(
        fmt::format("the surface was still moving after {} steps (--max-steps)", figures.advance.steps));
  }
}

}  // namespace

void add_segment(CLI::App& app, Program& program) {
  auto options = std::make_shared<SegmentOptions>();
  CLI::App& command = add_command(app, program, {"segment", kSummary, kDescription, kExamples},
                                  [&program, options] { return Segmentation(program, *options).run(); });
  add_segment_options(command, *options);
}

}  // namespace tidemark::cli
