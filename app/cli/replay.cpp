// tidemark-cli replay: the replay of a recipe.
#include <memory>

#include "app/cli/drive_options.h"
#include "app/cli/program.h"
#include "app/cli/recipe_files.h"
#include "app/cli/results.h"
#include "app/cli/solver_options.h"
#include "app/cli/study_input.h"
#include "document/checksum.h"
#include "imaging/load_study.h"
#include "solver/host/host_executor.h"

namespace tidemark::cli {
namespace {

constexpr CommandHelp kReplay{
    "replay", "Does again what a recipe says and writes mask, surface and figures",
    "Replays RECIPE, which segment --recipe and the desktop write, on INPUT: the same start, parameters and\n"
    "edits at the same steps. On the same volume with the same executor it gives the same voxels. Radii and\n"
    "patient coordinates of the recipe are in mm; another spacing is warned about. --tilt and --gaps are "
    "the\n"
    "recipe's where they are not given.",
    "  tidemark-cli replay liver.json ct.nrrd --out liver.nii.gz --stats liver-stats.json\n"
    "  tidemark-cli replay liver.json other/ --executor host --out other.stl\n"};

struct ReplayArguments {
  std::string recipe;
  StudyInput study;
  SolverOptions solver;
  ResultOptions results;
  DriveOptions images;
};

std::vector<std::string> inputs_of(const ReplayArguments& arguments) {
  std::vector<std::string> inputs = inputs_of(arguments.images);
  inputs.push_back(arguments.recipe);
  return inputs;
}

// The outcome of a replay, with the figures of segment.
RunResults results_of(const document::Recipe& recipe, const Volume& volume, const std::string& series_uid,
                      document::Evolution evolution, const ReplayArguments& arguments) {
  RunResults results;
  RunFigures& figures = results.figures;
  figures.geometry = volume.geometry;
  figures.modality = volume.modality;
  figures.unit = volume.unit;
  figures.description = volume.description;
  figures.series_uid = series_uid;
  figures.changes = volume.changes;
  if (recipe.final_smoothed_mm() > 0.0) figures.smooth_mm = recipe.final_smoothed_mm();
  // The same recipe for the volume and the executor at hand.
  results.recipe = recipe;
  results.recipe.source = {volume.geometry.size,
                           volume.geometry.spacing_mm,
                           arguments.study.series,
                           {},
                           arguments.study.policy(recipe.source.policy)};
  results.take(std::move(evolution));
  figures.threads = threads_of(arguments.solver, figures.executor);
  return results;
}

Status run_replay(Program& program, const ReplayArguments& arguments) {
  Console& console = program.console;
  ResultWriter writer(arguments.results, console);
  TIDEMARK_TRY(check(arguments.solver));
  TIDEMARK_TRY(writer.prepare());
  auto recipe = document::Recipe::load(arguments.recipe);
  if (!recipe) return pass_on(recipe);
  TIDEMARK_TRY(writer.spare(arguments.study, inputs_of(arguments), recipe->source.policy));
  auto study = load_study(arguments.study, console.progress(), recipe->source.policy);
  if (!study) return pass_on(study);
  const StudyPlace place = place_of(*study);
  auto volume = std::make_shared<const Volume>(std::move(study->volume));
  for (const std::string& difference : document::differences(*recipe, *volume)) console.warn(difference);
  TIDEMARK_TRY(give_images(*recipe, arguments.images, place, console));
  console.say("Recipe     {}; {} edits, {} steps", recipe->start.describe(), recipe->events.size(),
              recipe->steps);

  const document::EvolutionOptions options{arguments.solver.kind, arguments.solver.executor_options()};
  if (options.executor) recipe->set_executor(recipe->executor);
  auto evolution = document::evolve(*recipe, volume, options, console.progress());
  if (!evolution) {
    // What the environment asks for is no fault of the recipe's.
    TIDEMARK_TRY(solver::HostExecutor::chosen_kernels());
    // Arguments of ours were in order: what does not fit is the recipe.
    Error error = evolution.error();
    if (error.kind == ErrorKind::usage) error.kind = ErrorKind::input;
    if (error.kind == ErrorKind::input) error.message = arguments.recipe + ": " + error.message;
    return tl::unexpected<Error>(std::move(error));
  }
  RunResults results = results_of(*recipe, *volume, study->series.uid, std::move(*evolution), arguments);
  results.dicom_files = imaging::dicom_files_of(study->series);
  if (writer.wants_recipe()) results.recipe.source.checksum = document::checksum_of(*volume);
  volume.reset();
  TIDEMARK_TRY(writer.write(results));
  console.result(to_json(results.figures));
  return {};
}

}  // namespace

void add_replay(CLI::App& app, Program& program) {
  auto arguments = std::make_shared<ReplayArguments>();
  CLI::App& command =
      add_command(app, program, kReplay, [&program, arguments] { return run_replay(program, *arguments); });
  command.add_option("RECIPE", arguments->recipe, "A recipe (.json)")->required()->type_name("");
  add_study_input(command, arguments->study);
  add_solver_options(command, arguments->solver, "the recipe's");
  add_image_options(command, arguments->images);
  add_result_options(command, arguments->results);
}

}  // namespace tidemark::cli
